//! Arrays behind those of the mesh: keys, matrices, displacements. All are 32-bit floats.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use gltf::json::Value;
use gltf::json::accessor::Type;

/// Bytes copied at a time.
const BLOCK: usize = 1 << 20;

/// Arrays in the order they are written; large ones wait in a temporary file.
#[derive(Default)]
pub(super) struct Tail {
    pub(super) arrays: Vec<Stored>,
    spool: Option<File>,
}

/// An array.
pub(super) struct Stored {
    source: Source,
    bytes: u64,
    pub(super) count: usize,
    pub(super) kind: Type,
    pub(super) bounds: Option<[Value; 2]>,
    /// Whether it is a mesh's, one value a vertex.
    pub(super) is_vertex: bool,
}

enum Source {
    Memory(Vec<f32>),
    Spool,
}

impl Tail {
    /// Adds an array of values of so many numbers; its place among the arrays.
    pub(super) fn push(&mut self, kind: Type, values: Vec<f32>) -> usize {
        let bytes = 4 * values.len() as u64;
        let count = values.len() / kind.multiplicity();
        self.add(Stored {
            source: Source::Memory(values),
            bytes,
            count,
            kind,
            bounds: None,
            is_vertex: false,
        })
    }

    /// Adds the times of keys, with their bounds.
    pub(super) fn push_times(&mut self, times: Vec<f32>) -> usize {
        let bound = |time: Option<&f32>| Value::from(vec![time.copied().unwrap_or_default()]);
        let bounds = [bound(times.first()), bound(times.last())];
        let place = self.push(Type::Scalar, times);
        self.arrays[place].bounds = Some(bounds);
        place
    }

    /// Puts vectors, one a vertex, into the temporary file.
    pub(super) fn spool(&mut self, vectors: &[[f32; 3]]) -> io::Result<usize> {
        let file = match &mut self.spool {
            Some(file) => file,
            none => none.insert(tempfile::tempfile()?),
        };
        file.write_all(bytemuck::cast_slice(vectors))?;
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for vector in vectors {
            for axis in 0..3 {
                low[axis] = low[axis].min(vector[axis]);
                high[axis] = high[axis].max(vector[axis]);
            }
        }
        let bounds = [low, high].map(|corner| Value::from(corner.map(f64::from).to_vec()));
        let bytes = size_of_val(vectors) as u64;
        let (count, kind) = (vectors.len(), Type::Vec3);
        let bounds = Some(bounds);
        Ok(self.add(Stored { source: Source::Spool, bytes, count, kind, bounds, is_vertex: true }))
    }

    fn add(&mut self, array: Stored) -> usize {
        self.arrays.push(array);
        self.arrays.len() - 1
    }

    pub(super) fn bytes(&self) -> u64 {
        self.arrays.iter().map(Stored::bytes).sum()
    }

    /// Writes the arrays; what was spooled first comes first.
    pub(super) fn write(&self, stream: &mut impl Write) -> io::Result<()> {
        let mut spool = self.spool.as_ref();
        if let Some(file) = &mut spool {
            file.seek(SeekFrom::Start(0))?;
        }
        for array in &self.arrays {
            match (&array.source, spool) {
                (Source::Memory(values), _) => stream.write_all(bytemuck::cast_slice(values))?,
                (Source::Spool, Some(file)) => copy(file, array.bytes, stream)?,
                (Source::Spool, None) => {}
            }
        }
        Ok(())
    }
}

impl Stored {
    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }
}

fn copy(mut file: &File, bytes: u64, stream: &mut impl Write) -> io::Result<()> {
    let mut left = bytes;
    let mut block = vec![0; BLOCK];
    while left > 0 {
        let most = usize::try_from(left).unwrap_or(BLOCK).min(BLOCK);
        let Some(part) = block.get_mut(..most) else { break };
        file.read_exact(part)?;
        stream.write_all(part)?;
        left -= most as u64;
    }
    Ok(())
}
