//! Words, each stored once.

use std::collections::HashMap;

/// The tokens of a layer and the strings, which point to them.
#[derive(Debug)]
pub(super) struct Tokens {
    numbers: HashMap<String, u32>,
    /// Every token and a zero byte, in order.
    pub text: Vec<u8>,
    /// The token of each string.
    pub strings: Vec<u32>,
}

impl Tokens {
    pub fn new() -> Self {
        let mut tokens = Tokens { numbers: HashMap::new(), text: Vec::new(), strings: Vec::new() };
        // In the tree of paths a property is the negative of its name's number, so no name may have number 0.
        tokens.token(";-)");
        tokens
    }

    /// The number of `word`. A zero byte would end it, so it is dropped.
    pub fn token(&mut self, word: &str) -> u32 {
        if let Some(&number) = self.numbers.get(word) {
            return number;
        }
        let number = self.numbers.len() as u32;
        self.numbers.insert(word.to_owned(), number);
        self.text.extend(word.bytes().filter(|&byte| byte != 0));
        self.text.push(0);
        number
    }

    /// The number of `text` among the strings.
    pub fn string(&mut self, text: &str) -> u32 {
        let token = self.token(text);
        if let Some(place) = self.strings.iter().position(|&string| string == token) {
            return place as u32;
        }
        self.strings.push(token);
        (self.strings.len() - 1) as u32
    }

    pub fn len(&self) -> usize {
        self.numbers.len()
    }
}
