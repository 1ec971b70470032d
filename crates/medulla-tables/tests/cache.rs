//! Tables are found where they were left, and only if they are whole.
#![allow(clippy::unwrap_used)] // tests fail by panicking

use std::fs;
use std::sync::Arc;

use fibre_scattering::{FurParameters, MedullaKey, MedullaTable};
use medulla_tables::{CacheFault, Source, build, cache_file, find_in, needed};

/// A key of its own for each test: tables of equal keys are shared in memory. Few walks are quick.
fn key(kappa: f32) -> MedullaKey {
    MedullaKey { kappa, sigma_s: 1.5, g: 0.3, eta: 1.55, cuticle_layers: None, film_eta: None, walks: 60 }
}

/// What another process would find: past this one's memory.
fn from_disk(key: &MedullaKey, folder: &std::path::Path) -> MedullaTable {
    let bytes = fs::read(cache_file(folder, key)).unwrap();
    MedullaTable::from_bytes(&bytes[..bytes.len() - 32]).unwrap()
}

#[test]
fn built_once_then_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("not/yet/there");
    let key = key(0.51);
    let first = find_in(&key, Some(&inner)).unwrap();
    assert!(matches!(first.source, Source::Built { .. }) && first.fault.is_none());
    assert_eq!(from_disk(&key, &inner), *first.table);
    let second = find_in(&key, Some(&inner)).unwrap();
    assert_eq!(second.source, Source::Memory);
    assert!(Arc::ptr_eq(&first.table, &second.table));
}

#[test]
fn threads_change_nothing() {
    let key = key(0.52);
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let one = pool(1).install(|| build(&key)).unwrap();
    assert_eq!(one, pool(3).install(|| build(&key)).unwrap());
    assert_eq!(one, MedullaTable::build(&key).unwrap());
}

/// Leaves a file for `kappa` in a folder, as another process would, and hands its bytes to `spoil`.
fn spoiled(kappa: f32, spoil: impl Fn(&mut Vec<u8>)) -> (Source, Option<CacheFault>) {
    let folder = tempfile::tempdir().unwrap();
    // Quality is part of the key: the two share all but the memory of this process.
    let (key, written) = (key(kappa), build(&key(kappa)).unwrap());
    let path = cache_file(folder.path(), &key);
    let mut bytes = written.to_bytes();
    let digest = blake3::hash(&bytes);
    bytes.extend_from_slice(digest.as_bytes());
    spoil(&mut bytes);
    fs::write(&path, bytes).unwrap();
    let found = find_in(&key, Some(folder.path())).unwrap();
    assert_eq!(*found.table, written);
    assert_eq!(from_disk(&key, folder.path()), written, "a bad file is replaced");
    (found.source, found.fault)
}

#[test]
fn whole_files_are_read_and_others_replaced() {
    assert_eq!(spoiled(0.61, |_| ()), (Source::Disk, None));
    let damaged = |(source, fault)| {
        matches!(source, Source::Built { .. }) && matches!(fault, Some(CacheFault::Damaged { .. }))
    };
    assert!(damaged(spoiled(0.62, |bytes| bytes.truncate(1000))));
    assert!(damaged(spoiled(0.63, |bytes| bytes[5000] ^= 1)));
    assert!(damaged(spoiled(0.64, Vec::clear)));
    // Sound in itself, but of another material.
    assert!(damaged(spoiled(0.65, |bytes| {
        *bytes = build(&key(0.66)).unwrap().to_bytes();
        let digest = blake3::hash(bytes);
        bytes.extend_from_slice(digest.as_bytes());
    })));
}

#[test]
fn a_cache_that_cannot_be_written_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, b"in the way").unwrap();
    let found = find_in(&key(0.71), Some(&file)).unwrap();
    assert!(found.fault.is_some_and(|fault| fault.to_string().contains("file")));
    assert!(find_in(&key(0.72), None).unwrap().fault.is_none());
}

#[test]
fn nothing_is_built_for_hair_or_for_nonsense() {
    assert!(needed(&FurParameters::default()).unwrap().is_none());
    for bad in
        [MedullaKey { kappa: f32::NAN, ..key(0.5) }, MedullaKey { walks: u32::MAX, ..key(0.5) }, key(0.0)]
    {
        assert!(find_in(&bad, None).is_err());
    }
}

#[test]
fn many_threads_get_one_table() {
    let folder = tempfile::tempdir().unwrap();
    let key = key(0.81);
    let tables: Vec<_> = std::thread::scope(|scope| {
        let ask = || find_in(&key, Some(folder.path())).unwrap().table;
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(ask)).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(tables.iter().all(|table| Arc::ptr_eq(table, &tables[0])));
    assert_eq!(from_disk(&key, folder.path()), *tables[0]);
}
