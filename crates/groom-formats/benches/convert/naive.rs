//! Text as one would write it without thinking of speed, and by NumPy.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::Command;

use groom::{Groom, Vec3View};

use crate::Result;

/// The loop of any exporter.
pub(crate) fn write(groom: &Groom, path: &Path) -> Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    let (radii, colors) = (groom.radii(), groom.colors().unwrap_or(Vec3View::Constant(glam::Vec3::ONE)));
    for (strand, points) in groom.strands().enumerate() {
        for (i, p) in points.iter().enumerate() {
            let vertex = groom.strand_range(strand).start + i;
            let (r, c) = (radii.get(strand, vertex), colors.get(strand, vertex));
            writeln!(out, "{} {} {} {r} {} {} {}", p.x, p.y, p.z, c.x, c.y, c.z)?;
        }
        writeln!(out)?;
    }
    out.flush()?;
    Ok(())
}

/// The loop of any importer.
pub(crate) fn read(path: &Path) -> Result<usize> {
    let mut rows: Vec<Vec<f32>> = Vec::new();
    for line in fs::read_to_string(path)?.lines() {
        rows.push(line.split_whitespace().map(str::parse).collect::<std::result::Result<_, _>>()?);
    }
    Ok(std::hint::black_box(rows).len())
}

/// `numpy.savetxt` of the same columns, timed inside Python; the interpreter is `$GROOMKIT_PYTHON` or the
/// one that `cargo xtask setup` makes.
pub(crate) fn savetxt(input: &Path, output: &Path) -> Command {
    const SCRIPT: &str = r"
import resource, struct, sys, time
import numpy as np
start, cpu = time.perf_counter(), time.process_time()
data = open(sys.argv[1], 'rb').read()
strands, points, arrays = struct.unpack_from('<3I', data, 4)
at = 128 + (2 * strands if arrays & 1 else 0)
p = np.frombuffer(data, '<f4', 3 * points, at).reshape(-1, 3)
at += 12 * points + sum(4 * points for bit in (4, 8) if arrays & bit)
c = np.frombuffer(data, '<f4', 3 * points, at).reshape(-1, 3) if arrays & 16 else np.ones((points, 3), 'f4')
table = np.hstack([p, np.full((points, 1), 0.05, 'f4'), c])
read, read_cpu = time.perf_counter(), time.process_time()
np.savetxt(sys.argv[2], table, fmt='%.9g')
print(read - start, read_cpu - cpu, time.perf_counter() - read, time.process_time() - read_cpu,
      resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)
";
    let made = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/venv/bin/python");
    let python = std::env::var("GROOMKIT_PYTHON").unwrap_or_else(|_| made.to_owned());
    let mut command = Command::new(python);
    command.args(["-c", SCRIPT]).args([input, output]);
    command
}
