//! The tev viewer, by its messages.
//!
//! A message is its length in bytes (u32, itself included), its kind (u8) and its contents, all little-endian;
//! texts end in a zero byte. Source: tev's `include/tev/Ipc.h` and `src/Ipc.cpp`, as of version 1.23 and later
//! (message 6, `UpdateImageV3`).

use std::io::Write as _;
use std::net::{SocketAddr, TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use crate::ViewError;

/// How long the viewer may take to answer or to read.
const PATIENCE: Duration = Duration::from_secs(5);

/// Bytes of pixels in a message, about: a viewer should be able to show the first while the next comes.
const MOST_BYTES: u64 = 8 << 20;

const CREATE: u8 = 4;
const UPDATE: u8 = 6;

/// A part of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Left edge, pixels.
    pub x: u32,
    /// Upper edge, pixels.
    pub y: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

/// A picture in a running viewer.
#[derive(Debug)]
pub struct Tev {
    stream: TcpStream,
    address: String,
    name: String,
    size: (u32, u32),
    channels: Vec<String>,
}

impl Tev {
    /// Connects to the viewer at `address` (`host:port`; tev listens on 127.0.0.1:14158) and makes a black picture
    /// there. A channel called `TT.R` is shown as red of the layer `TT`.
    ///
    /// # Errors
    /// [`ViewError::Name`], [`ViewError::Size`] or [`ViewError::Viewer`].
    pub fn create(address: &str, name: &str, size: (u32, u32), channels: &[&str]) -> Result<Tev, ViewError> {
        let fault = |found: &str, reason| ViewError::Name { found: found.to_owned(), reason };
        for text in channels.iter().chain([&name]) {
            if text.is_empty() || text.contains('\0') {
                return Err(fault(text, "is empty or holds a zero byte"));
            }
        }
        let (width, height) = size;
        let is_size = |edge: u32| (1..=i32::MAX as u32).contains(&edge);
        if channels.is_empty() || !is_size(width) || !is_size(height) {
            return Err(ViewError::Size { found: channels.len(), width, height, expected: 1 });
        }
        let viewer = |action, source| ViewError::Viewer { address: address.to_owned(), action, source };
        let places = address.to_socket_addrs().map_err(|e| viewer("find the host", e))?;
        let stream = connected(places).map_err(|e| viewer("connect to tev", e))?;
        stream.set_write_timeout(Some(PATIENCE)).map_err(|e| viewer("connect to tev", e))?;
        let mut message = Message::new(CREATE);
        // Comes to the front.
        message.byte(1);
        message.text(name);
        message.number(width);
        message.number(height);
        message.number(channels.len() as u32);
        channels.iter().for_each(|channel| message.text(channel));
        let channels = channels.iter().map(|&channel| channel.to_owned()).collect();
        let mut tev = Tev { stream, address: address.to_owned(), name: name.to_owned(), size, channels };
        tev.send(message)?;
        Ok(tev)
    }

    /// Puts new values into a tile: for every pixel, row by row, one of each channel in their order.
    ///
    /// # Errors
    /// [`ViewError::Tile`], [`ViewError::Size`] or [`ViewError::Viewer`].
    pub fn update(&mut self, tile: Tile, values: &[f32]) -> Result<(), ViewError> {
        let Tile { x, y, width, height } = tile;
        let inside = |from: u32, length: u32, whole: u32| {
            length > 0 && from.checked_add(length).is_some_and(|end| end <= whole)
        };
        if !inside(x, width, self.size.0) || !inside(y, height, self.size.1) {
            return Err(ViewError::Tile { x, y, width, height, whole: self.size });
        }
        let row = u64::from(width) * self.channels.len() as u64;
        let expected = row * u64::from(height);
        if values.len() as u64 != expected {
            return Err(ViewError::Size { found: values.len(), width, height, expected });
        }
        let rows = (MOST_BYTES / (row * 4)).clamp(1, u64::from(height)) as usize;
        for (index, part) in values.chunks(row as usize * rows).enumerate() {
            let down = part.len() / row as usize;
            let tile = Tile { x, y: y + (index * rows) as u32, width, height: down as u32 };
            self.send_tile(tile, part)?;
        }
        Ok(())
    }

    fn send_tile(&mut self, tile: Tile, values: &[f32]) -> Result<(), ViewError> {
        let mut message = Message::new(UPDATE);
        // Stays where it is.
        message.byte(0);
        message.text(&self.name);
        let count = self.channels.len();
        message.number(count as u32);
        self.channels.iter().for_each(|channel| message.text(channel));
        [tile.x, tile.y, tile.width, tile.height].into_iter().for_each(|number| message.number(number));
        // Where each channel begins among the values, and how far apart its values are.
        (0..count).for_each(|channel| message.long(channel as u64));
        (0..count).for_each(|_| message.long(count as u64));
        message.0.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self.send(message)
    }

    fn send(&mut self, message: Message) -> Result<(), ViewError> {
        let Message(mut bytes) = message;
        let length = (bytes.len() as u32).to_le_bytes();
        bytes[..4].copy_from_slice(&length);
        let viewer =
            |source| ViewError::Viewer { address: self.address.clone(), action: "send to tev", source };
        self.stream.write_all(&bytes).map_err(viewer)
    }
}

/// A connection to the first of `places` that takes one: `localhost` is two, and tev listens on one of them.
fn connected(places: impl Iterator<Item = SocketAddr>) -> std::io::Result<TcpStream> {
    let mut fault = std::io::Error::from(std::io::ErrorKind::AddrNotAvailable);
    for place in places {
        match TcpStream::connect_timeout(&place, PATIENCE) {
            Ok(stream) => return Ok(stream),
            Err(refused) => fault = refused,
        }
    }
    Err(fault)
}

/// A message being written; its first four bytes are the place of its length.
struct Message(Vec<u8>);

impl Message {
    fn new(kind: u8) -> Self {
        Message(vec![0, 0, 0, 0, kind])
    }

    fn byte(&mut self, value: u8) {
        self.0.push(value);
    }

    fn number(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    fn long(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.0.extend(text.as_bytes());
        self.0.push(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A host of two addresses, of which the first is nobody's.
    #[test]
    fn every_address_of_a_host_is_tried() {
        let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let open = listener.local_addr().unwrap();
        let closed = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
        assert!(connected([closed, open].into_iter()).is_ok());
        assert!(connected([closed].into_iter()).is_err() && connected(std::iter::empty()).is_err());
    }
}
