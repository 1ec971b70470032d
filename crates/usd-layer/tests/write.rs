//! Crates and packages as bytes; usd-core's opinion of them is in the end-to-end tests.

#![allow(clippy::unwrap_used)] // helpers of tests

use std::io::{self, Cursor, Seek, SeekFrom, Write};

use usd_layer::write::{Attribute, Content, CrateWriter, PackageWriter, Value, WriteError};

type Memory = Cursor<Vec<u8>>;

fn layer() -> CrateWriter<Memory> {
    CrateWriter::new(Cursor::new(Vec::new())).unwrap()
}

fn fill<W: Write + Seek>(layer: &mut CrateWriter<W>) {
    let top = layer.prim("/Top", "Xform").unwrap();
    let points = layer.store(Value::Float3s(&[[1.0, 2.0, 3.0]; 100])).unwrap();
    layer.attribute(top, Attribute::new("points", "point3f[]", Content::Value(points))).unwrap();
}

#[test]
fn the_same_value_is_stored_once() {
    let bytes_with = |arrays: usize| {
        let mut layer = layer();
        let array: Vec<[f32; 3]> = (0..1000).map(|i| [i as f32, 0.0, 1.0]).collect();
        let stored: Vec<_> = (0..arrays).map(|_| layer.store(Value::Float3s(&array)).unwrap()).collect();
        assert!(stored.iter().all(|value| *value == stored[0]));
        layer.prim("/Top", "Xform").unwrap();
        layer.finish().unwrap().into_inner()
    };
    assert_eq!(bytes_with(1), bytes_with(10));
    // The same bytes as something else are another value.
    let mut layer = layer();
    let floats = layer.store(Value::Floats(&[1.0, 2.0])).unwrap();
    assert_ne!(
        layer.store(Value::Ints(&[1.0_f32.to_bits() as i32, 2.0_f32.to_bits() as i32])).unwrap(),
        floats
    );
    assert_ne!(
        layer.store(Value::Float2([1.0, 2.0])).unwrap(),
        layer.store(Value::Float2s(&[[1.0, 2.0]])).unwrap()
    );
}

#[test]
fn broken_stages_are_refused() {
    let mut layer = layer();
    let top = layer.prim("/Top", "Xform").unwrap();
    assert!(matches!(layer.prim("/Top", "Xform"), Err(WriteError::Twice { .. })));
    assert!(matches!(layer.prim("/", "Xform"), Err(WriteError::Twice { .. })));
    assert!(matches!(layer.prim("Top", "Xform"), Err(WriteError::Path { .. })));
    let attribute = Attribute::new("a", "int", Content::Nothing);
    layer.attribute(top, attribute).unwrap();
    assert!(matches!(layer.attribute(top, attribute), Err(WriteError::Twice { .. })));
    let bad = Attribute { name: "a b", ..attribute };
    assert!(matches!(layer.attribute(top, bad), Err(WriteError::Path { .. })));
    let nowhere = Attribute { name: "c", content: Content::Connection("/Top"), ..attribute };
    assert!(matches!(layer.attribute(top, nowhere), Err(WriteError::Path { .. })));

    let mut other = self::layer();
    assert!(matches!(other.attribute(top, attribute), Err(WriteError::UnknownPrim { .. })));
    other.prim("/Top/Child", "Scope").unwrap();
    let error = other.finish().unwrap_err();
    assert_eq!(error.to_string(), "`/Top/Child` has no parent prim; write that one too");
}

#[test]
fn a_layer_may_start_anywhere() {
    let mut alone = layer();
    fill(&mut alone);
    let alone = alone.finish().unwrap().into_inner();
    let mut stream = Cursor::new(vec![7; 100]);
    stream.seek(SeekFrom::Start(100)).unwrap();
    let mut behind = CrateWriter::new(stream).unwrap();
    fill(&mut behind);
    let stream = behind.finish().unwrap();
    assert_eq!(stream.position(), stream.get_ref().len() as u64);
    assert_eq!(stream.into_inner()[100..], alone);
}

#[test]
fn a_package_is_a_zip_of_the_layer() {
    let mut alone = layer();
    fill(&mut alone);
    let alone = alone.finish().unwrap().into_inner();
    for name in
        ["a.usdc", "a name of thirty bytes or.usdc", "a name so long that the head takes two blocks.usdc"]
    {
        let mut package = PackageWriter::new(Cursor::new(Vec::new()), name).unwrap();
        fill(package.layer());
        let zip = package.finish().unwrap().into_inner();
        let short = |at: usize| usize::from(u16::from_le_bytes(zip[at..at + 2].try_into().unwrap()));
        let long = |at: usize| u32::from_le_bytes(zip[at..at + 4].try_into().unwrap()) as usize;
        let start = 30 + short(26) + short(28);
        assert_eq!((&zip[..4], short(8), start % 64), (&b"PK\x03\x04"[..], 0, 0), "stored, aligned");
        assert_eq!(&zip[30..30 + short(26)], name.as_bytes());
        assert_eq!((long(18), long(22)), (alone.len(), alone.len()));
        assert_eq!(zip[start..start + alone.len()], alone);
        assert_eq!(long(14), crc32fast::hash(&alone) as usize);
        let directory = start + alone.len();
        assert_eq!(&zip[directory..directory + 4], b"PK\x01\x02");
        assert_eq!(zip[directory + 16..directory + 28], zip[14..26], "checksum and sizes");
        let end = directory + 46 + name.len();
        assert_eq!((&zip[end..end + 4], zip.len()), (&b"PK\x05\x06"[..], end + 22));
        assert_eq!((short(end + 10), long(end + 12), long(end + 16)), (1, end - directory, directory));
    }
}

/// A disk that is full after some bytes.
struct Full(Memory, u64);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0.position() + bytes.len() as u64 > self.1 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Full {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

#[test]
fn a_full_disk_is_told_wherever_it_fills() {
    let write = |room| -> Result<u64, WriteError> {
        let mut package = PackageWriter::new(Full(Cursor::new(Vec::new()), room), "a.usdc")?;
        package.layer().store(Value::Floats(&[0.1, 0.2]))?;
        package.layer().prim("/Top", "Xform")?;
        Ok(package.finish()?.0.position())
    };
    let length = write(u64::MAX).unwrap();
    for room in 0..length {
        assert!(matches!(write(room), Err(WriteError::Io(_))), "{room} of {length}");
    }
}
