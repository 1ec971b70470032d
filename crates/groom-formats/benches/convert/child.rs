//! One conversion in a process of its own.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use cyhair::{Field, HairWriter, Header, Strand};
use groom_formats::{ReadOptions, WriteOptions, convert_streaming, read, write};

use crate::{Result, naive, usage};

/// Set for a process that is to do one job: how, input and output.
const JOB: [&str; 3] = ["GROOM_FORMATS_JOB", "GROOM_FORMATS_INPUT", "GROOM_FORMATS_OUTPUT"];

pub(crate) struct Job {
    how: String,
    input: PathBuf,
    output: PathBuf,
}

/// Seconds, and bytes.
pub(crate) struct Measured {
    pub(crate) read_wall: f64,
    pub(crate) read_cpu: f64,
    pub(crate) write_wall: f64,
    pub(crate) write_cpu: f64,
    pub(crate) peak: f64,
}

/// Does the job in another process; `None` when it cannot be done here.
pub(crate) fn measure(how: &str, input: &Path, output: &Path) -> Result<Option<Measured>> {
    let mut child = if how == "savetxt" {
        naive::savetxt(input, output)
    } else {
        let mut child = Command::new(std::env::current_exe()?);
        child.env(JOB[0], how).env(JOB[1], input).env(JOB[2], output);
        child
    };
    let Ok(done) = child.output() else { return Ok(None) };
    let said = String::from_utf8(done.stdout)?;
    let figures: Vec<f64> = said.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [read_wall, read_cpu, write_wall, write_cpu, peak] = figures[..] else { return Ok(None) };
    Ok(Some(Measured { read_wall, read_cpu, write_wall, write_cpu, peak }))
}

impl Job {
    pub(crate) fn asked_of_this_process() -> Option<Job> {
        let [how, input, output] = JOB.map(std::env::var_os);
        Some(Job { how: how?.into_string().ok()?, input: input?.into(), output: output?.into() })
    }

    pub(crate) fn run(&self) -> Result<()> {
        let (read_options, write_options) = (ReadOptions::default(), WriteOptions::default());
        let start = (Instant::now(), usage::cpu_seconds());
        let nothing_to_read = matches!(self.how.as_str(), "streamed" | "naive read");
        let loaded = if nothing_to_read { None } else { Some(read(&self.input, &read_options)?) };
        let middle = (Instant::now(), usage::cpu_seconds());
        match (self.how.as_str(), &loaded) {
            ("whole", Some(loaded)) => {
                write(&loaded.groom, &self.output, &WriteOptions { hair: loaded.hair, ..write_options })?;
            }
            ("streamed", _) => {
                let done = convert_streaming(&self.input, &self.output, &read_options, &write_options)?;
                done.ok_or("this pair does not stream")?;
            }
            ("naive", Some(loaded)) => naive::write(&loaded.groom, &self.output)?,
            ("naive read", _) => {
                naive::read(&self.input)?;
            }
            _ => {}
        }
        let end = (Instant::now(), usage::cpu_seconds());
        let mut phases = [(middle.0 - start.0, middle.1 - start.1), (end.0 - middle.0, end.1 - middle.1)];
        if self.how == "naive read" {
            phases.swap(0, 1);
        }
        for (wall, cpu) in phases {
            println!("{} {cpu}", wall.as_secs_f64());
        }
        println!("{}", usage::peak().unwrap_or_default());
        Ok(())
    }
}

/// Writes a HAIR file of `strands` strands of 68 or 69 segments with all arrays, a strand at a time; returns how many points it has.
pub(crate) fn large(path: &Path, strands: u32) -> Result<u64> {
    let lengths = || (0..strands).map(|strand| 68 + usize::from(strand % 5 != 0));
    let points = lengths().sum::<usize>();
    let arrays = Field::ARRAYS.iter().map(|field| field.bit()).sum();
    let header = Header { hair_count: strands, point_count: points as u32, arrays, ..Header::default() };
    let mut writer = HairWriter::counting(BufWriter::new(File::create(path)?), header)?;
    for (strand, length) in lengths().enumerate() {
        let number =
            |i: usize| ((strand * 71 + i) as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
        let triples: Vec<[f32; 3]> =
            (0..length).map(|i| [number(i), number(i + 7), number(i + 13)]).collect();
        let floats: Vec<f32> = (0..length).map(number).collect();
        writer.push(Strand {
            points: Some(&triples),
            thickness: Some(&floats),
            transparency: Some(&floats),
            colors: Some(&triples),
        })?;
    }
    writer.finish()?;
    Ok(points as u64)
}
