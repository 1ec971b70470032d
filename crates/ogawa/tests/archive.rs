//! Archives byte by byte, there and back, and broken.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use std::io::{Cursor, Seek, SeekFrom, Write};

use ogawa::{
    Archive, ArchiveWriter, Compound, DataType, Metadata, Object, OgawaError, Pod, Property, PropertyKind,
    TimeSampling,
};
use proptest::prelude::*;

type File = ArchiveWriter<Cursor<Vec<u8>>>;

fn archive(build: impl FnOnce(&mut File, &mut Object)) -> Vec<u8> {
    let mut file = ArchiveWriter::new(Cursor::new(Vec::new())).unwrap();
    let mut top = Object::top();
    build(&mut file, &mut top);
    file.finish(&top, &Metadata::new().with("_ai_Application", "test")).unwrap().into_inner()
}

/// One object `a` with `ids` = [1, 2] and a compound with a text.
fn small() -> Vec<u8> {
    archive(|file, top| {
        let mut object = Object::new("a", Metadata::new().with("schema", "S"));
        let ids = Property::array("ids", DataType::I32, Metadata::new());
        object.properties.push(ids.with(file.values(&[1_i32, 2]).unwrap()));
        let mut inner = Compound::new();
        let text = Property::scalar("text", DataType::STRING, Metadata::new());
        inner.push(text.with(file.texts(&["hi"]).unwrap()));
        object.properties.push(Property::compound("more", Metadata::new(), inner));
        top.children.push(object);
    })
}

/// What stands in a file, by a second reading of the layout that shares nothing with the crate's.
#[derive(Debug, PartialEq)]
enum Node {
    Group(Vec<Node>),
    Data(Vec<u8>),
}

fn node(file: &[u8], place: u64) -> Node {
    let word = |at: usize| u64::from_le_bytes(file[at..at + 8].try_into().unwrap());
    let data = place >> 63 == 1;
    let at = (place & !(1 << 63)) as usize;
    match (at, data) {
        (0, true) => Node::Data(vec![]),
        (0, false) => Node::Group(vec![]),
        (_, true) => Node::Data(file[at + 8..at + 8 + word(at) as usize].to_vec()),
        (_, false) => Node::Group((1..=word(at) as usize).map(|i| node(file, word(at + 8 * i))).collect()),
    }
}

#[test]
fn the_bytes_are_those_of_the_layout() {
    let bytes = small();
    assert_eq!(&bytes[..8], b"Ogawa\xff\x00\x01");
    let root = u64::from_le_bytes(bytes[8..16].try_into().unwrap());
    let Node::Group(children) = node(&bytes, root) else { panic!() };
    let data = |bytes: &[u8]| Node::Data(bytes.to_vec());
    assert_eq!(children[0], data(&[0, 0, 0, 0]));
    assert_eq!(children[1], data(&10808_i32.to_le_bytes()));
    assert_eq!(children[3], data(b"_ai_Application=test"));
    let times = [&1_u32.to_le_bytes()[..], &1.0_f64.to_le_bytes(), &1_u32.to_le_bytes(), &[0; 8]].concat();
    assert_eq!(children[4], data(&times));
    assert_eq!(children[5], data(b"\x08schema=S"));
    let Node::Group(top) = &children[2] else { panic!() };
    let [Node::Group(none), Node::Group(object), Node::Data(headers)] = &top[..] else { panic!() };
    assert_eq!((none.len(), &headers[..headers.len() - 32]), (0, &b"\x01\0\0\0a\x01"[..]));
    let [Node::Group(properties), Node::Data(no_children)] = &object[..] else { panic!() };
    assert_eq!(no_children.len(), 32);
    let [Node::Group(ids), Node::Group(more), Node::Data(headers)] = &properties[..] else { panic!() };
    let [Node::Data(sample), dimensions] = &ids[..] else { panic!() };
    assert_eq!((sample.len(), &sample[16..]), (24, &[1, 0, 0, 0, 2, 0, 0, 0][..]));
    assert_eq!(dimensions, &data(&[]), "the size says the number of values");
    // Array 2, i32 6 << 4, one size 0x400, constant 0x800, extent 1 << 12; one sample; name. Compound: 0.
    let first = 2_u32 | 6 << 4 | 0x400 | 0x800 | 1 << 12;
    let expected = [&first.to_le_bytes()[..], b"\x01\x03ids", &[0; 4], b"\x04more"].concat();
    assert_eq!(headers, &expected);
    let [Node::Group(text), Node::Data(headers)] = &more[..] else { panic!() };
    let [Node::Data(sample)] = &text[..] else { panic!() };
    assert_eq!(&sample[16..], b"hi\0");
    let first = 1_u32 | 12 << 4 | 0x400 | 0x800 | 1 << 12;
    assert_eq!(headers, &[&first.to_le_bytes()[..], b"\x01\x04text"].concat());
}

#[test]
fn an_archive_may_begin_anywhere_in_a_stream_and_ends_at_its_end() {
    let mut stream = Cursor::new(b"before".to_vec());
    stream.seek(SeekFrom::End(0)).unwrap();
    let file = ArchiveWriter::new(stream).unwrap();
    let mut stream = file.finish(&Object::top(), &Metadata::new()).unwrap();
    stream.write_all(b"after").unwrap();
    let bytes = stream.into_inner();
    let inside = bytes.strip_prefix(b"before").unwrap().strip_suffix(b"after").unwrap();
    assert_eq!(Archive::new(inside).unwrap().top().children().unwrap().count(), 0);
}

proptest! {
    #[test]
    fn samples_come_back(samples in prop::collection::vec(prop::collection::vec(0_u8..3, 0..4), 0..12), array: bool) {
        let values: Vec<Vec<u8>> =
            samples.into_iter().map(|s| if array { s } else { vec![s.first().copied().unwrap_or(9)] }).collect();
        let bytes = archive(|file, top| {
            let times = file.add_times(TimeSampling::uniform(0.5, 1.0));
            let mut property = match array {
                true => Property::array("p", DataType::U8, Metadata::new()),
                false => Property::scalar("p", DataType::U8, Metadata::new()),
            }
            .at(times);
            values.iter().for_each(|values| property.push(file.values(values).unwrap()));
            top.properties.push(property);
        });
        let archive = Archive::new(&bytes).unwrap();
        let property = archive.top().properties().unwrap().find("p").unwrap().unwrap();
        prop_assert_eq!(property.kind(), if array { PropertyKind::Array } else { PropertyKind::Scalar });
        prop_assert_eq!(property.sample_count(), values.len() as u64);
        prop_assert_eq!(property.is_constant(), values.windows(2).all(|pair| pair[0] == pair[1]));
        for (i, values) in values.iter().enumerate() {
            prop_assert_eq!(&property.sample(i as u64).unwrap().to_vec::<u8>().unwrap(), values);
        }
        prop_assert!(property.sample(values.len() as u64).is_err());
        prop_assert_eq!(property.times().unwrap().time(2), Some(2.0));
    }

    #[test]
    fn texts_come_back(texts in prop::collection::vec("[^\0]{0,5}", 0..5)) {
        let bytes = archive(|file, top| {
            let property = Property::array("p", DataType::STRING, Metadata::new());
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            top.properties.push(property.with(file.texts(&texts).unwrap()));
        });
        let archive = Archive::new(&bytes).unwrap();
        let sample = archive.top().properties().unwrap().find("p").unwrap().unwrap().sample(0).unwrap();
        prop_assert_eq!(sample.texts().unwrap(), texts);
    }

    #[test]
    fn flipped_bytes_do_no_harm(flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5)) {
        let mut bytes = small();
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = walk(&bytes);
    }
}

/// Looks at everything a file holds, its first 8 samples at least.
fn walk(bytes: &[u8]) -> Result<usize, OgawaError> {
    fn in_compound(compound: &ogawa::CompoundReader<'_>, budget: &mut usize) -> Result<(), OgawaError> {
        for property in compound.iter() {
            let property = property?;
            *budget += 1;
            if *budget > 100_000 {
                return Ok(());
            }
            if property.kind() == PropertyKind::Compound {
                in_compound(&property.compound()?, budget)?;
                continue;
            }
            for sample in 0..property.sample_count().min(8) {
                let sample = property.sample(sample)?;
                let _ = (sample.len(), sample.to_f32(), sample.to_f64(), sample.to_i32(), sample.texts());
            }
            let _ = property.times();
        }
        Ok(())
    }
    fn in_object(object: &ogawa::ObjectReader<'_>, budget: &mut usize) -> Result<(), OgawaError> {
        in_compound(&object.properties()?, budget)?;
        for child in object.children()? {
            *budget += 1;
            if *budget > 100_000 {
                return Ok(());
            }
            in_object(&child?, budget)?;
        }
        Ok(())
    }
    let archive = Archive::new(bytes)?;
    let mut budget = 0;
    in_object(&archive.top(), &mut budget)?;
    Ok(budget)
}

#[test]
fn every_truncation_is_refused_with_its_place() {
    let bytes = small();
    assert_eq!(walk(&bytes).unwrap(), 4);
    for len in 0..bytes.len() {
        let error = walk(&bytes[..len]).unwrap_err();
        assert!(matches!(error, OgawaError::Invalid { .. }), "{len}: {error}");
    }
}

#[test]
fn an_object_in_itself_is_refused() {
    let mut bytes = small();
    let word = |bytes: &[u8], at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let top = word(&bytes, word(&bytes, 8) + 24);
    // The top's second child is the object: hang the top there.
    bytes[top + 16..top + 24].copy_from_slice(&(top as u64).to_le_bytes());
    let error = walk(&bytes).unwrap_err().to_string();
    assert!(error.contains("more than 256 objects in each other"), "{error}");
}

#[test]
fn long_names_and_many_samples_take_wider_counts() {
    let long = "n".repeat(300);
    let words = Metadata::new().with("key", &"v".repeat(70_000));
    let bytes = archive(|file, top| {
        let mut many = Property::array(&long, DataType::U8, Metadata::new());
        for i in 0..70_000_u32 {
            many.push(file.values(&[(i / 35_000) as u8]).unwrap());
        }
        top.properties.push(many);
        top.properties.push(Property::compound("c", words.clone(), Compound::new()));
        top.children.push(Object::new("o", words.clone()));
        for i in 0..300 {
            let word = Metadata::new().with("i", &i.to_string());
            top.children.push(Object::new(&format!("o{i}"), word));
        }
    });
    let archive = Archive::new(&bytes).unwrap();
    let properties = archive.top().properties().unwrap();
    let many = properties.find(&long).unwrap().unwrap();
    assert_eq!(many.sample_count(), 70_000);
    for (sample, value) in [(0, 0), (34_999, 0), (35_000, 1), (69_999, 1)] {
        assert_eq!(many.sample(sample).unwrap().bytes(), [value]);
    }
    assert_eq!(properties.find("c").unwrap().unwrap().metadata().get("key"), words.get("key"));
    let names: Vec<_> = archive.top().children().unwrap().map(Result::unwrap).collect();
    assert_eq!(names[0].metadata().get("key"), words.get("key"));
    for (i, object) in names[1..].iter().enumerate() {
        assert_eq!(object.metadata().get("i"), Some(i.to_string().as_str()), "the table has 254 places");
    }
}

#[test]
fn what_the_layout_cannot_hold_is_refused() {
    let refused = |object: Object| {
        let file = ArchiveWriter::new(Cursor::new(Vec::new())).unwrap();
        let mut top = Object::top();
        top.children.push(object);
        assert!(matches!(file.finish(&top, &Metadata::new()), Err(OgawaError::Unwritable { .. })));
    };
    refused(Object::new("a/b", Metadata::new()));
    refused(Object::new("", Metadata::new()));
    refused(Object::new("a", Metadata::new().with("k", "a;b")));
    let mut object = Object::new("a", Metadata::new());
    object.properties.push(Property::scalar("a/b", DataType::new(Pod::I8, 1), Metadata::new()));
    refused(object);
    assert!(ArchiveWriter::new(Cursor::new(Vec::new())).unwrap().texts(&["a\0b"]).is_err());
}
