//! Pictures read back from what a terminal and a viewer are sent.
#![allow(clippy::unwrap_used)]

use std::io::Read as _;
use std::net::TcpListener;
use std::thread;

use base64::Engine as _;
use frame_view::{Manner, Picture, Tev, Tile, ViewError, drawn};
use proptest::prelude::*;

/// Red rises to the right, green downwards.
fn picture(width: u32, height: u32) -> Picture {
    let pixel = |x: u32, y: u32| [(x * 255 / width.max(2)) as u8, (y * 255 / height.max(2)) as u8, 77, 255];
    let rgba: Vec<u8> = (0..height).flat_map(|y| (0..width).flat_map(move |x| pixel(x, y))).collect();
    Picture::from_rgba(width, height, &rgba).unwrap()
}

/// A character of half blocks: its upper and its lower pixel.
type Cell = ([u8; 3], Option<[u8; 3]>);

/// The pixels a terminal would show for half blocks.
fn shown(text: &str) -> Vec<Vec<Cell>> {
    let mut lines = vec![Vec::new()];
    let (mut front, mut back) = ([0; 3], None);
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        if let Some(code) = rest.strip_prefix("\x1b[") {
            let (code, after) = code.split_once('m').unwrap();
            let numbers: Vec<u8> = code.split(';').map(|n| n.parse().unwrap()).collect();
            match numbers[..] {
                [38, 2, r, g, b] => front = [r, g, b],
                [48, 2, r, g, b] => back = Some([r, g, b]),
                [0] => (front, back) = ([0; 3], None),
                _ => unreachable!("{numbers:?}"),
            }
            rest = after;
            continue;
        }
        match c {
            '\n' => lines.push(Vec::new()),
            '\u{2580}' => lines.last_mut().unwrap().push((front, back)),
            other => unreachable!("{other:?}"),
        }
        rest = &rest[c.len_utf8()..];
    }
    lines.pop();
    lines
}

#[test]
fn half_blocks_show_every_pixel() {
    let text = String::from_utf8(drawn(&picture(6, 5), (6, 9), Manner::Blocks).unwrap()).unwrap();
    let lines = shown(&text);
    assert_eq!(lines.len(), 3);
    for (row, line) in lines.iter().enumerate() {
        assert_eq!(line.len(), 6);
        for (x, (upper, lower)) in line.iter().enumerate() {
            let pixel = |y: usize| [(x * 255 / 6) as u8, (y * 255 / 5) as u8, 77];
            assert_eq!(*upper, pixel(2 * row));
            assert_eq!(*lower, (row < 2).then(|| pixel(2 * row + 1)));
        }
    }
}

proptest! {
    #[test]
    fn nothing_is_wider_or_higher_than_the_terminal(
        (width, height) in (1u32..80, 1u32..80),
        (columns, rows) in (0u16..60, 0u16..40),
    ) {
        let text = String::from_utf8(drawn(&picture(width, height), (columns, rows), Manner::Blocks).unwrap()).unwrap();
        let lines = shown(&text);
        prop_assert!(!lines.is_empty() && lines.len() <= usize::from(rows).saturating_sub(1).max(1));
        prop_assert!(lines.iter().all(|line| line.len() <= usize::from(columns).max(1)));
    }
}

#[test]
fn kitty_gets_all_pixels_in_pieces() {
    let bytes = drawn(&picture(80, 60), (80, 24), Manner::Kitty).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let pieces: Vec<(&str, &str)> = text
        .split("\x1b_G")
        .skip(1)
        .map(|p| p.split("\x1b\\").next().unwrap().split_once(';').unwrap())
        .collect();
    assert!(pieces.len() > 1 && pieces[0].0.starts_with("a=T,f=24,q=2,s=80,v=60,c="), "{}", pieces[0].0);
    let (last, first) = pieces.split_last().unwrap();
    assert!(first.iter().all(|(keys, data)| keys.ends_with("m=1") && data.len() == 4096));
    assert_eq!(last.0, "m=0");
    let data: String = pieces.iter().map(|(_, data)| *data).collect();
    let rgb = base64::engine::general_purpose::STANDARD.decode(data).unwrap();
    assert_eq!(rgb.len(), 80 * 60 * 3);
    assert_eq!(rgb[3 * 79..3 * 80], [(79 * 255 / 80) as u8, 0, 77]);
}

#[test]
fn inline_pictures_are_pngs_of_the_right_size() {
    let text = String::from_utf8(drawn(&picture(50, 20), (40, 24), Manner::Inline).unwrap()).unwrap();
    let (keys, data) = text.trim_end_matches("\x07\n").split_once(':').unwrap();
    assert!(
        keys.starts_with("\x1b]1337;File=inline=1;size=") && keys.contains(";width=40;height=8;"),
        "{keys:?}"
    );
    let png = base64::engine::general_purpose::STANDARD.decode(data).unwrap();
    let picture = image::load_from_memory(&png).unwrap();
    assert_eq!((picture.width(), picture.height()), (50, 20));
}

#[test]
fn sixels_paint_every_pixel_once() {
    let text = String::from_utf8(drawn(&picture(50, 20), (40, 24), Manner::Sixel).unwrap()).unwrap();
    let body = text.strip_prefix("\x1bPq\"1;1;50;20").unwrap().strip_suffix("\x1b\\\n").unwrap();
    let mut painted = vec![0; 50 * 20];
    let (mut x, mut band) = (0usize, 0usize);
    let mut letters = body.chars().peekable();
    let number = |letters: &mut std::iter::Peekable<std::str::Chars>| {
        let mut value = 0usize;
        while let Some(digit) = letters.peek().and_then(|c| c.to_digit(10)) {
            value = value * 10 + digit as usize;
            letters.next();
        }
        value
    };
    while let Some(c) = letters.next() {
        let times = match c {
            '$' => {
                x = 0;
                continue;
            }
            '-' => {
                (x, band) = (0, band + 1);
                continue;
            }
            '#' => {
                assert!(number(&mut letters) < 216);
                while letters.peek() == Some(&';') {
                    letters.next();
                    number(&mut letters);
                }
                continue;
            }
            '!' => number(&mut letters),
            _ => 1,
        };
        let bits = if c == '!' { letters.next().unwrap() } else { c } as u32 - 63;
        for _ in 0..times {
            (0..6).filter(|row| bits >> row & 1 == 1).for_each(|row| painted[(band * 6 + row) * 50 + x] += 1);
            x += 1;
        }
    }
    assert!(painted.iter().all(|&times| times == 1));
}

/// A server that takes messages apart as tev does.
struct Server {
    address: String,
    messages: thread::JoinHandle<Vec<Vec<u8>>>,
}

impl Server {
    fn start() -> Server {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap().to_string();
        let messages = thread::spawn(move || {
            let (mut stream, _) = listener.accept().unwrap();
            let mut messages = Vec::new();
            let mut length = [0; 4];
            while stream.read_exact(&mut length).is_ok() {
                let mut message = vec![0; u32::from_le_bytes(length) as usize - 4];
                stream.read_exact(&mut message).unwrap();
                messages.push(message);
            }
            messages
        });
        Server { address, messages }
    }
}

/// Reads a message from its front.
struct Cursor<'a>(&'a [u8]);

impl Cursor<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (head, tail) = self.0.split_at(N);
        self.0 = tail;
        head.try_into().unwrap()
    }
    fn int(&mut self) -> i32 {
        i32::from_le_bytes(self.take())
    }
    fn long(&mut self) -> i64 {
        i64::from_le_bytes(self.take())
    }
    fn text(&mut self) -> String {
        let end = self.0.iter().position(|&b| b == 0).unwrap();
        let text = String::from_utf8(self.0[..end].to_vec()).unwrap();
        self.0 = &self.0[end + 1..];
        text
    }
}

#[test]
fn tev_is_sent_the_picture_tile_by_tile() {
    let server = Server::start();
    let channels = ["R", "G", "B", "A"];
    let mut tev = Tev::create(&server.address, "frame 1: \u{e9}", (1920, 800), &channels).unwrap();
    let values: Vec<f32> = (0..1920 * 798 * 4).map(|i| i as f32 * 0.5).collect();
    tev.update(Tile { x: 0, y: 1, width: 1920, height: 798 }, &values).unwrap();
    tev.update(Tile { x: 3, y: 4, width: 2, height: 1 }, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, f32::NAN])
        .unwrap();
    let outside = tev.update(Tile { x: 1919, y: 0, width: 2, height: 1 }, &[0.0; 8]);
    assert!(matches!(outside, Err(ViewError::Tile { x: 1919, .. })));
    assert!(matches!(
        tev.update(Tile { x: 0, y: 0, width: 2, height: 1 }, &[0.0; 7]),
        Err(ViewError::Size { .. })
    ));
    drop(tev);

    let messages = server.messages.join().unwrap();
    let mut create = Cursor(&messages[0]);
    assert_eq!(create.take(), [4, 1]);
    assert_eq!(create.text(), "frame 1: \u{e9}");
    assert_eq!([create.int(), create.int(), create.int()], [1920, 800, 4]);
    assert!(channels.iter().all(|name| create.text() == *name) && create.0.is_empty());

    let mut picture = vec![f32::NEG_INFINITY; 1920 * 800 * 4];
    for message in &messages[1..] {
        let mut update = Cursor(message);
        assert_eq!(update.take(), [6, 0]);
        assert_eq!(update.text(), "frame 1: \u{e9}");
        assert_eq!(update.int(), 4);
        assert!(channels.iter().all(|name| update.text() == *name));
        let [x, y, width, height] =
            [update.int(), update.int(), update.int(), update.int()].map(|n| n as usize);
        let offsets: Vec<i64> = (0..4).map(|_| update.long()).collect();
        let strides: Vec<i64> = (0..4).map(|_| update.long()).collect();
        let data: Vec<f32> = update.0.chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        assert_eq!(data.len(), width * height * 4);
        for pixel in 0..width * height {
            let at = (y + pixel / width) * 1920 + x + pixel % width;
            for channel in 0..4 {
                picture[at * 4 + channel] =
                    data[offsets[channel] as usize + pixel * strides[channel] as usize];
            }
        }
    }
    assert!(messages.len() > 3, "large tiles go in parts");
    assert!(picture[..1920 * 4].iter().all(|v| *v == f32::NEG_INFINITY), "row 0 was not sent");
    let small = (4 * 1920 + 3) * 4;
    assert_eq!(picture[small..small + 7], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    assert!(picture[small + 7].is_nan());
    picture[small..small + 8].copy_from_slice(&values[small - 1920 * 4..small - 1920 * 4 + 8]);
    assert!(picture[1920 * 4..1920 * 799 * 4] == values[..]);
}

#[test]
fn a_viewer_that_is_not_there_is_named() {
    let free = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let error = Tev::create(&free, "x", (1, 1), &["R"]).unwrap_err().to_string();
    assert!(error.contains(&free) && error.contains("connect"), "{error}");
    for (name, size, channels) in
        [("", (1, 1), &["R"][..]), ("a\0b", (1, 1), &["R"]), ("a", (0, 1), &["R"]), ("a", (1, 1), &[])]
    {
        assert!(Tev::create(&free, name, size, channels).is_err(), "{name:?}");
    }
}
