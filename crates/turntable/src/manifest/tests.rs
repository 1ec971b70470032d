use super::*;
use crate::digest::Ingredients;

fn digest(word: &str) -> Digest {
    Ingredients::of(word).finish()
}

fn open(folder: &Path) -> Manifest {
    Manifest::open(folder, false)
}

#[test]
fn two_runs_keep_each_others_entries() {
    let folder = tempfile::tempdir().unwrap();
    let mut runs = [open(folder.path()), open(folder.path())];
    for (run, name) in runs.iter_mut().zip(["a.txt", "b.txt"]) {
        std::fs::write(folder.path().join(name), name).unwrap();
        run.record(Path::new(name), &digest("1")).unwrap();
    }
    let both = open(folder.path());
    for name in ["a.txt", "b.txt"] {
        assert_eq!(both.digest_of(Path::new(name)), Some(digest("1").as_str()));
    }
}

#[test]
fn entries_answer_for_digest_and_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (name, one) = (Path::new("a.txt"), digest("1"));
    let write = |text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let is_one = |manifest: &Manifest| manifest.digest_of(name) == Some(one.as_str());
    assert_eq!(open(folder.path()).digest_of(name), None);
    write("x");
    open(folder.path()).record(name, &one).unwrap();
    assert!(is_one(&open(folder.path())));
    assert!(open(folder.path()).knows(name, one.as_str()));
    assert!(!open(folder.path()).knows(name, digest("2").as_str()));
    write("y");
    assert_eq!(open(folder.path()).digest_of(name), None, "another byte, written at once");
    write("x");
    assert!(is_one(&open(folder.path())), "and back");
    std::fs::remove_file(folder.path().join(name)).unwrap();
    assert_eq!(open(folder.path()).digest_of(name), None);
    write("x");
    for broken in
        ["", "{", "{\"file\":\"a.txt\",\"digest\":\"d\",\"content\":\"c\",\"check\":\"00000000\"}\n"]
    {
        std::fs::write(folder.path().join(FILE), broken).unwrap();
        assert_eq!(open(folder.path()).digest_of(name), None);
    }
}

#[test]
fn what_has_rested_is_not_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let (name, one) = (Path::new("a.txt"), digest("1"));
    std::fs::write(folder.path().join(name), "x").unwrap();
    let mut manifest = open(folder.path());
    manifest.record(name, &one).unwrap();
    assert!(open(folder.path()).has_to_read(name), "its time may not tell it from what comes next");
    manifest.close().unwrap();
    assert!(!open(folder.path()).has_to_read(name));
    assert_eq!(open(folder.path()).digest_of(name), Some(one.as_str()));
    // Copied with its time, as a backup comes back: read once, and sound.
    let modified = folder.path().join(name).metadata().unwrap().modified().unwrap();
    std::fs::write(folder.path().join(name), "x").unwrap();
    std::fs::File::options()
        .write(true)
        .open(folder.path().join(name))
        .unwrap()
        .set_modified(modified)
        .unwrap();
    assert_eq!(open(folder.path()).digest_of(name), Some(one.as_str()));
}

#[test]
fn only_reading_tells_a_file_with_the_stamp_of_another() {
    let folder = tempfile::tempdir().unwrap();
    let (name, one) = (Path::new("a.txt"), digest("1"));
    std::fs::write(folder.path().join(name), "y").unwrap();
    let stamps = stamps(&folder.path().join(name)).unwrap();
    // As if these bytes had once been others, and nothing about the file had changed since.
    let content = blake3::hash(b"x").to_hex()[..32].to_owned();
    let entry = Entry { file: "a.txt".into(), digest: one.as_str().to_owned(), content, stamps };
    Journal::open(folder.path().join(FILE)).0.add(&[entry]).unwrap();
    assert_eq!(Manifest::open(folder.path(), false).digest_of(name), Some(one.as_str()));
    assert_eq!(Manifest::open(folder.path(), true).digest_of(name), None);
}

#[test]
fn whoever_errs_about_one_file_is_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    let name = Path::new("a.txt");
    std::fs::write(folder.path().join(name), "x").unwrap();
    // Two runs made it from different things; both saw the bytes of the one that came last.
    for word in ["1", "2"] {
        let mut run = open(folder.path());
        run.record(name, &digest(word)).unwrap();
        run.close().unwrap();
    }
    assert_eq!(open(folder.path()).digest_of(name), None);
    std::fs::write(folder.path().join(name), "z").unwrap();
    open(folder.path()).record(name, &digest("2")).unwrap();
    assert_eq!(open(folder.path()).digest_of(name), Some(digest("2").as_str()));
}

#[test]
fn inputs_are_remembered_by_their_stamp() {
    let folder = tempfile::tempdir().unwrap();
    let stamp = Stamp { size: 1, modified: 1, changed: 1 };
    let old = (PathBuf::from("/in/a.hair"), stamp, digest("a"));
    let fresh = Stamp { modified: u64::MAX, ..stamp };
    let mut manifest = open(folder.path());
    manifest.record_inputs(&[old.clone(), ("/in/b.hair".into(), fresh, digest("b"))]).unwrap();
    assert_eq!(open(folder.path()).inputs().collect::<Vec<_>>(), [old]);
    assert_eq!(Manifest::open(folder.path(), true).inputs().count(), 0);
}
