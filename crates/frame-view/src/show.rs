//! The frame being rendered, to the people in front of it: in tev, and in the terminal.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use command_line::say;
use glam::Vec3;
use hair_render::{Backdrop, Frame, ToneMapping, tone_map};

use crate::{Manner, Picture, Tev, Tile, ViewError, drawn};

/// Developing a picture takes time of the render: not more often than this.
const PAUSE: Duration = Duration::from_secs(1);

/// Where frames are shown.
#[derive(Debug)]
pub struct Show {
    server: Option<Server>,
    /// How the terminal shows pictures, where one was asked to.
    terminal: Option<Manner>,
    exposure: f32,
    last: Option<Instant>,
}

#[derive(Debug)]
struct Server {
    address: String,
    name: String,
    /// The viewer's picture, and pixels across and down it.
    tev: Option<(Tev, (u32, u32))>,
}

impl Show {
    /// In the viewer at `server`, under this name, and in the terminal on stderr, `exposure` stops brighter.
    #[must_use]
    pub fn new(server: Option<&str>, name: &str, terminal: bool, exposure: f32) -> Show {
        let server =
            server.map(|address| Server { address: address.to_owned(), name: name.to_owned(), tev: None });
        let manner =
            || Manner::of(|name| std::env::var(name).ok()).filter(|_| std::io::stderr().is_terminal());
        let manner = terminal.then(manner);
        if manner == Some(None) {
            say("warning: --preview: stderr is no terminal that shows pictures");
        }
        Show { server, terminal: manner.flatten(), exposure, last: None }
    }

    /// Whether the viewer is to be sent a picture now: at most one a second.
    #[must_use]
    pub fn is_due(&self) -> bool {
        self.server.is_some() && self.last.is_none_or(|last| last.elapsed() >= PAUSE)
    }

    /// Sends the picture to the viewer; one that does not listen is told of once, and is no reason to stop.
    pub fn send(&mut self, frame: &Frame) {
        self.last = Some(Instant::now());
        if let Some(server) = &mut self.server
            && let Err(fault) = server.send(frame)
        {
            say(&format!("warning: --display-server: {fault}: the picture is shown there no more"));
            self.server = None;
        }
    }

    /// Draws the picture in the terminal.
    pub fn draw(&self, frame: &Frame) {
        let Some(manner) = self.terminal else { return };
        if let Err(fault) = self.try_draw(frame, manner) {
            say(&format!("warning: --preview: {fault}"));
        }
    }

    fn try_draw(&self, frame: &Frame, manner: Manner) -> Result<(), ViewError> {
        let backdrop = Backdrop::Solid(Vec3::splat(0.18));
        let mapping = ToneMapping { exposure: self.exposure, backdrop, ..ToneMapping::default() };
        let preview = tone_map(frame, &mapping);
        let picture = Picture::from_rgba(frame.width, frame.height, &preview.rgba)?;
        let bytes = drawn(&picture, terminal_size(), manner)?;
        std::io::stderr().lock().write_all(&bytes).map_err(ViewError::Terminal)
    }
}

impl Server {
    fn send(&mut self, frame: &Frame) -> Result<(), ViewError> {
        let (whole, x, y) = match frame.cutout {
            Some(cutout) => ((cutout.full_width, cutout.full_height), cutout.x, cutout.y),
            None => ((frame.width, frame.height), 0, 0),
        };
        // Frames of another variant may have another size.
        let mut tev = match self.tev.take().filter(|(_, size)| *size == whole) {
            Some((tev, _)) => tev,
            None => Tev::create(&self.address, &self.name, whole, &["R", "G", "B", "A"])?,
        };
        let pixels = frame.beauty.iter().zip(&frame.alpha);
        let values: Vec<f32> = pixels.flat_map(|(rgb, &alpha)| [rgb.x, rgb.y, rgb.z, alpha]).collect();
        tev.update(Tile { x, y, width: frame.width, height: frame.height }, &values)?;
        self.tev = Some((tev, whole));
        Ok(())
    }
}

/// Columns and rows of the terminal.
fn terminal_size() -> (u16, u16) {
    terminal_size::terminal_size_of(std::io::stderr()).map_or((80, 24), |(columns, rows)| (columns.0, rows.0))
}

#[cfg(test)]
mod tests {
    use std::io::Read;
    use std::net::TcpListener;

    use super::*;

    /// What kinds of messages a viewer was sent, until nobody speaks to it any more.
    fn kinds(mut bytes: &[u8]) -> Vec<u8> {
        let mut kinds = Vec::new();
        while let Some((length, rest)) = bytes.split_first_chunk::<4>() {
            kinds.push(rest[0]);
            bytes = &bytes[u32::from_le_bytes(*length) as usize..];
        }
        kinds
    }

    #[test]
    fn frames_of_another_size_are_another_picture() {
        let viewer = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = viewer.local_addr().unwrap().to_string();
        let listening = std::thread::spawn(move || {
            let hear = |_| {
                let mut bytes = Vec::new();
                viewer.accept().unwrap().0.read_to_end(&mut bytes).unwrap();
                kinds(&bytes)
            };
            (0..2).map(hear).collect::<Vec<_>>()
        });
        let mut show = Show::new(Some(&address), "turn", false, 0.0);
        for (width, height) in [(4, 3), (4, 3), (2, 3)] {
            show.send(&Frame::empty(width, height));
        }
        assert!(show.server.is_some(), "a frame was refused");
        drop(show);
        // Message 4 makes a picture, message 6 fills it.
        assert_eq!(listening.join().unwrap(), [vec![4, 6, 6], vec![4, 6]]);
    }

    #[test]
    fn a_viewer_that_is_not_there_is_tried_once() {
        let nobody = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
        let mut show = Show::new(Some(&nobody), "turn", false, 0.0);
        assert!(show.is_due());
        show.send(&Frame::empty(1, 1));
        assert!(!show.is_due() && show.server.is_none());
    }
}
