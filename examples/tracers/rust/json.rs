//! A small JSON reader (RFC 8259), for files that are known to be JSON: raytruth has checked them.

use std::collections::HashMap;

pub enum Json {
    Null,
    Bool,
    Number(f64), // the one nearest to the decimal in the file
    Text(String),
    List(Vec<Json>),
    Object(HashMap<String, Json>),
}

impl Json {
    pub fn read(text: &str) -> Json {
        Reader { text: text.as_bytes(), at: 0 }.value()
    }

    /// What a key states; none if it is missing or null.
    pub fn get(&self, key: &str) -> Option<&Json> {
        match self {
            Json::Object(members) => members.get(key).filter(|value| !matches!(value, Json::Null)),
            _ => None,
        }
    }

    /// What a required key states.
    pub fn at(&self, key: &str) -> &Json {
        self.get(key).unwrap_or_else(|| panic!("the scene does not state `{key}`"))
    }

    pub fn number(&self) -> f64 {
        if let Json::Number(number) = self { *number } else { panic!("a number is expected") }
    }

    pub fn text(&self) -> &str {
        if let Json::Text(text) = self { text } else { panic!("a text is expected") }
    }

    pub fn list(&self) -> &[Json] {
        if let Json::List(list) = self { list } else { panic!("a list is expected") }
    }

    pub fn members(&self) -> &HashMap<String, Json> {
        if let Json::Object(members) = self { members } else { panic!("an object is expected") }
    }
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    /// The next character that is not blank.
    fn peek(&mut self) -> u8 {
        while b" \n\r\t".contains(&self.text[self.at]) {
            self.at += 1;
        }
        self.text[self.at]
    }

    fn take(&mut self, wanted: u8) -> bool {
        let found = self.peek() == wanted;
        self.at += found as usize;
        found
    }

    fn value(&mut self) -> Json {
        match self.peek() {
            b'{' => Json::Object(self.object()),
            b'[' => Json::List(self.list()),
            b'"' => Json::Text(self.string()),
            b'n' => self.word("null", Json::Null),
            b't' => self.word("true", Json::Bool),
            b'f' => self.word("false", Json::Bool),
            _ => {
                let length = self.text[self.at..].iter().take_while(|c| b"+-.eE0123456789".contains(c)).count();
                let digits = std::str::from_utf8(&self.text[self.at..self.at + length]).unwrap();
                self.at += length;
                Json::Number(digits.parse().expect("a JSON value is expected"))
            }
        }
    }

    fn word(&mut self, word: &str, value: Json) -> Json {
        self.at += word.len();
        value
    }

    fn object(&mut self) -> HashMap<String, Json> {
        let mut members = HashMap::new();
        self.at += 1;
        while !self.take(b'}') {
            self.peek();
            let key = self.string();
            self.take(b':');
            members.insert(key, self.value());
            self.take(b',');
        }
        members
    }

    fn list(&mut self) -> Vec<Json> {
        let mut items = Vec::new();
        self.at += 1;
        while !self.take(b']') {
            items.push(self.value());
            self.take(b',');
        }
        items
    }

    fn string(&mut self) -> String {
        let mut bytes = Vec::new();
        self.at += 1;
        while self.text[self.at] != b'"' {
            let mut byte = self.text[self.at];
            self.at += 1;
            if byte == b'\\' {
                byte = self.text[self.at];
                self.at += 1;
                if byte == b'u' {
                    bytes.extend(self.escaped().to_string().as_bytes());
                    continue;
                }
                if let Some(place) = b"bfnrt".iter().position(|&letter| letter == byte) {
                    byte = b"\x08\x0c\n\r\t"[place]; // else it is one of \" \\ \/
                }
            }
            bytes.push(byte);
        }
        self.at += 1;
        String::from_utf8(bytes).expect("a scene file is in UTF-8")
    }

    /// The character that \u and four digits stand for, or two of these: \uD83D\uDE00.
    fn escaped(&mut self) -> char {
        let mut code = self.hexadecimal();
        if (0xD800..0xDC00).contains(&code) {
            self.at += 2;
            code = 0x10000 + ((code - 0xD800) << 10) + (self.hexadecimal() - 0xDC00);
        }
        char::from_u32(code).expect("half of a character")
    }

    fn hexadecimal(&mut self) -> u32 {
        let digits = std::str::from_utf8(&self.text[self.at..self.at + 4]).unwrap();
        self.at += 4;
        u32::from_str_radix(digits, 16).unwrap()
    }
}
