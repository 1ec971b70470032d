//! The picture so far, to the people in front of it: in tev, and in the terminal.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

use anyhow::Result;
use command_line::say;
use frame_view::{Manner, Picture, Tev, Tile, drawn};
use glam::Vec3;
use hair_render::{Backdrop, Frame, ToneMapping, tone_map};

/// Developing a picture takes time of the render: not more often than this.
const PAUSE: Duration = Duration::from_secs(1);

/// Where pictures are shown.
pub struct Show {
    server: Option<Server>,
    /// How the terminal shows pictures, where one was asked to.
    terminal: Option<Manner>,
    exposure: f32,
    last: Option<Instant>,
}

struct Server {
    address: String,
    name: String,
    tev: Option<Tev>,
}

impl Show {
    /// In the viewer at `server`, under this name, and in the terminal.
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

    /// Whether somebody is to be shown a picture now.
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

    fn try_draw(&self, frame: &Frame, manner: Manner) -> Result<()> {
        let backdrop = Backdrop::Solid(Vec3::splat(0.18));
        let mapping = ToneMapping { exposure: self.exposure, backdrop, ..ToneMapping::default() };
        let preview = tone_map(frame, &mapping);
        let picture = Picture::from_rgba(frame.width, frame.height, &preview.rgba)?;
        let bytes = drawn(&picture, terminal_size(), manner)?;
        std::io::stderr().lock().write_all(&bytes)?;
        Ok(())
    }
}

impl Server {
    fn send(&mut self, frame: &Frame) -> Result<()> {
        let (whole, x, y) = match frame.cutout {
            Some(cutout) => ((cutout.full_width, cutout.full_height), cutout.x, cutout.y),
            None => ((frame.width, frame.height), 0, 0),
        };
        let mut tev = match self.tev.take() {
            Some(tev) => tev,
            None => Tev::create(&self.address, &self.name, whole, &["R", "G", "B", "A"])?,
        };
        let pixels = frame.beauty.iter().zip(&frame.alpha);
        let values: Vec<f32> = pixels.flat_map(|(rgb, &alpha)| [rgb.x, rgb.y, rgb.z, alpha]).collect();
        tev.update(Tile { x, y, width: frame.width, height: frame.height }, &values)?;
        self.tev = Some(tev);
        Ok(())
    }
}

/// Columns and rows of the terminal.
fn terminal_size() -> (u16, u16) {
    terminal_size::terminal_size_of(std::io::stderr()).map_or((80, 24), |(columns, rows)| (columns.0, rows.0))
}
