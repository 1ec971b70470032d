//! Which machine this is, as a part of file names.

use std::sync::LazyLock;

/// Letters of a host's name that are kept.
const LONGEST: usize = 32;

/// Linux's number for the processes that are in no container (`PROC_PID_INIT_INO`).
const ALL_PROCESSES: &str = "4026531836";

static HOST: LazyLock<String> = LazyLock::new(|| {
    let told = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let variable = |name: &str| std::env::var(name).ok();
    let told = told.or_else(|| variable("HOSTNAME")).or_else(|| variable("COMPUTERNAME"));
    let Some(host) = told.as_deref().and_then(as_word) else { return String::new() };
    // Containers may be called as their machine is, and do not see each other's processes.
    let link = std::fs::read_link("/proc/self/ns/pid").unwrap_or_default();
    let number: String = link.to_string_lossy().chars().filter(char::is_ascii_digit).collect();
    let in_container = !number.is_empty() && number != ALL_PROCESSES;
    in_container.then(|| as_word(&format!("{host}-{number}"))).flatten().unwrap_or(host)
});

/// The name of this machine, in letters, digits, `-` and `_`; `None` where it cannot be had.
pub(crate) fn host() -> Option<&'static str> {
    Some(HOST.as_str()).filter(|name| !name.is_empty())
}

/// A name without dots, which divide the parts of a temporary name, and not too long for one.
fn as_word(name: &str) -> Option<String> {
    let name = name.trim();
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
    let word: String = name.chars().map(plain).collect();
    if word.len() <= LONGEST {
        return (!word.is_empty()).then_some(word);
    }
    // Long names differ at their ends as often as at their beginnings: FNV-1a of all of it tells them apart.
    let hash =
        name.bytes().fold(0x811c_9dc5u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    let start = word.get(..LONGEST - 9).unwrap_or_default();
    Some(format!("{start}-{hash:08x}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_hosts_are_one_word_and_stay_apart() {
        assert_eq!(as_word("render07\n").as_deref(), Some("render07"));
        assert_eq!(as_word("node.farm.example").as_deref(), Some("node-farm-example"));
        assert_eq!(as_word("  \n"), None);
        let long = |end: &str| as_word(&format!("hair-render-job-2041-worker-pool-{end}")).unwrap();
        assert_eq!(long("x7f2a").len(), LONGEST);
        assert_ne!(long("x7f2a"), long("x7f2b"));
        assert_eq!(as_word("käfer").as_deref(), Some("k-fer"));
    }
}
