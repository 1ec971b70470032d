//! LZ4 as crates frame it (OpenUSD, `pxr/base/tf/fastCompression.cpp`): one byte with the number of chunks, 0
//! for a single block; else each chunk after its size as an i32.

use crate::write::WriteError;

/// The most bytes one LZ4 block may stand for.
const CHUNK: usize = 0x7E00_0000;
const MOST_CHUNKS: usize = 127;

/// `bytes`, compressed and framed.
pub(super) fn compress(bytes: &[u8]) -> Result<Vec<u8>, WriteError> {
    compress_in_chunks(bytes, CHUNK)
}

fn compress_in_chunks(bytes: &[u8], chunk: usize) -> Result<Vec<u8>, WriteError> {
    if bytes.len() <= chunk {
        let mut out = vec![0; 1 + lz4_flex::block::get_maximum_output_size(bytes.len())];
        let length = block(bytes, &mut out[1..])?;
        out.truncate(1 + length);
        return Ok(out);
    }
    let count = bytes.len().div_ceil(chunk);
    let too_large = WriteError::TooLarge {
        what: "bytes in one compressed array",
        found: bytes.len() as u64,
        limit: MOST_CHUNKS as u64 * chunk as u64,
    };
    let count = u8::try_from(count).ok().filter(|&n| usize::from(n) <= MOST_CHUNKS).ok_or(too_large)?;
    let mut out = vec![count];
    for chunk in bytes.chunks(chunk) {
        let start = out.len() + size_of::<i32>();
        out.resize(start + lz4_flex::block::get_maximum_output_size(chunk.len()), 0);
        let length = block(chunk, &mut out[start..])?;
        out.truncate(start + length);
        out[start - size_of::<i32>()..start].copy_from_slice(&(length as i32).to_le_bytes());
    }
    Ok(out)
}

fn block(bytes: &[u8], out: &mut [u8]) -> Result<usize, WriteError> {
    lz4_flex::block::compress_into(bytes, out).map_err(|e| WriteError::Io(std::io::Error::other(e)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_block_or_chunks_come_back() {
        let bytes: Vec<u8> = (0..1000_u32).flat_map(|i| (i * i / 7).to_le_bytes()).collect();
        let whole = compress(&bytes).unwrap();
        assert_eq!(whole[0], 0);
        assert_eq!(lz4_flex::block::decompress(&whole[1..], bytes.len()).unwrap(), bytes);

        let pieces = compress_in_chunks(&bytes, 1500).unwrap();
        assert_eq!(pieces[0], 3);
        let (mut rest, mut back) = (&pieces[1..], Vec::new());
        while let Some((size, after)) = rest.split_first_chunk::<4>() {
            let (block, after) = after.split_at(i32::from_le_bytes(*size) as usize);
            back.extend(lz4_flex::block::decompress(block, 1500).unwrap());
            rest = after;
        }
        assert_eq!(back, bytes);
        assert!(matches!(compress_in_chunks(&bytes, 10), Err(WriteError::TooLarge { .. })));
        assert_eq!(compress(&[]).unwrap(), [0, 0]);
    }
}
