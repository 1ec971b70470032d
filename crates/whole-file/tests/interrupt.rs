//! What an interrupt does; in a process of its own, since it is done to all files of a process.

use std::io::Write;

use whole_file::{WholeFile, abandon_all};

#[test]
fn an_interrupt_leaves_nothing_but_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let names =
        || std::fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect::<Vec<_>>();
    let old = folder.path().join("old");
    std::fs::write(&old, "old").unwrap();
    let mut files = [WholeFile::create(&old).unwrap(), WholeFile::create(folder.path().join("new")).unwrap()];
    for file in &mut files {
        file.write_all(b"half").unwrap();
    }
    assert_eq!(names().len(), 3);
    abandon_all();
    assert_eq!(names(), ["old"]);
    for file in files {
        assert!(file.commit().is_err());
    }
    assert_eq!((names().len(), std::fs::read(&old).unwrap()), (1, b"old".to_vec()));
}
