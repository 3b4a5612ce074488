//! Statements near the limits of what shortcuts of the parser take: mostly plain, with one or two odd parts, broken
//! lines, full columns, identifications and changed bytes.

/// An endless list of texts, each of one statement or a few lines. A seed always gives the same list.
pub struct FuzzedStatements {
    state: u64,
}

const WORDS: &[&str] = &[
    "GOTO",
    "GOTO  ",
    "GOTO ",
    "CIRCLE",
    "PAINT",
    "FEDRAT",
    "RAPID",
    "SPINDL",
    "LOADTL",
    "LOAD",
    "CYCLE",
    "CUTCOM",
    "TLDATA",
    "MSYS",
    "TLAXIS",
    "INDIRV",
    "AUTOPS",
    "TLON,GOFWD",
    "TOOLNO",
    "CUTTER",
    "MULTAX",
    "END-OF-PATH",
    "NURBS",
    "KNOT",
    "CNTRL",
    "COOLNT",
    "DELAY",
    "HELICAL",
    "PSIS",
    "goto",
    "N10 GOTO",
    "PPRINT",
    "PARTNO",
    "TPRINT",
    "TOOL PATH",
    "REMARK",
    "INSERT",
    "$$",
    "$$ ",
    "$$->",
    "$$*CATIA0",
    "L1=LINE",
    "X)",
    "CHANNEL,1",
    "FINI",
    "CSI_SET_FLUTE_LENGTH",
    "",
    " ",
    "PPRINTX",
    "T",
    "RE",
    "TLON, GOFWD",
    "WORD.A",
    "A:B",
];
const TEXTS: &[&str] = &[
    "MMPM",
    "IPM",
    "COLOR",
    "RPM",
    "CLW",
    "TOOL",
    "ADJUST",
    "ON",
    "OFF",
    "INTOF",
    "LEFT",
    "XYPLAN",
    "MILL",
    "DRILL",
    "TIMES",
    "R390-25A25L-17L",
    "1STPECK",
    "Drill (12)",
    "A/B",
    "a=b",
    "'it, $$'",
    "(note)",
    "(CIRCLE/1.0, 2.0,3,4.5)",
    "(LINE/0.0,0.0,1.0,$\n 2.0,3.0,4.0)",
    "( CIRCLE / 1 , 2 )",
    "(CIRCLE/)",
    "(LINE/1,A)",
    "(LINE/1,2",
    "X Y",
    "E5",
    ".",
    "-",
    "+",
    "-.",
    "5E",
    "1.2.3",
    "1-2",
    "\u{e9}",
    "A$$B",
    "",
    " ",
    "\t",
    "A'B",
    "A\u{1}",
];
const BREAKS: &[&str] =
    &["$\n", "$\n", "$\r\n", "$ \n", "$ c\n", "$$\n", "$\r", "$\n$\n", "$\n ", "$\n\n", "$"];
const ENDS: &[&str] = &[
    "\n",
    "\n",
    "\n",
    "\r\n",
    " \n",
    "",
    ",\n",
    "$\n",
    "$$ end\n",
    "\r",
    "\t\n",
    "  \r\n",
    "$",
    " $$\n",
    ",$\n1\n",
    " 00000010\n",
    "PT     2\n",
    "\n\n",
    "\nGOTO/1,2,3\n",
    "\n5,6,7\n",
    ")\n",
];

impl FuzzedStatements {
    pub fn new(seed: u64) -> Self {
        Self { state: seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1 }
    }

    /// The next number below `limit` (xorshift64*).
    fn below(&mut self, limit: usize) -> usize {
        self.state ^= self.state >> 12;
        self.state ^= self.state << 25;
        self.state ^= self.state >> 27;
        (self.state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % limit
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn pick<'s>(&mut self, list: &[&'s str]) -> &'s str {
        let index = self.below(list.len());
        list.get(index).copied().unwrap_or_default()
    }

    /// Puts in a number as CAM systems print it, seldom an odd one.
    fn push_number(&mut self, text: &mut String) {
        for _ in 0..if self.one_in(3) { self.below(12) } else { 0 } {
            text.push(' ');
        }
        let number = match self.below(70) {
            0 => format!("{}", self.below(1000)),
            1 => format!("{}.", self.below(1000)),
            2 => format!("-.{:03}", self.below(1000)),
            3 => format!("{}E{}", self.below(100), self.below(12)),
            4 => format!("+{}.5", self.below(100)),
            5 => format!("{}.{:017}", self.below(100_000_000), self.below(1_000_000_000)),
            6 => format!("0.{:025}", self.below(1000)),
            _ => format!(
                "{}{}.{:05}",
                if self.one_in(3) { "-" } else { "" },
                self.below(2000),
                self.below(100_000)
            ),
        };
        if self.one_in(30) {
            let at = self.below(number.len() + 1);
            text.push_str(&number[..at]);
            text.push_str(self.pick(BREAKS));
            text.push_str(&number[at..]);
        } else {
            text.push_str(&number);
        }
    }

    fn push_field(&mut self, text: &mut String) {
        if self.one_in(4) {
            let field = self.pick(TEXTS);
            text.push_str(field);
        } else {
            self.push_number(text);
        }
        if self.one_in(12) {
            text.push_str(&" ".repeat(self.below(4)));
        }
    }

    /// Breaks a line in column 72 or beside it, as systems do whose lines are full, or puts an identification there.
    fn fill_columns(&mut self, text: &mut String) {
        let end = text.find(['\n', '\r']).unwrap_or(text.len());
        let column = 70 + self.below(4);
        if !text.is_ascii() {
            return;
        }
        if end > column {
            text.insert_str(column, "$\n");
        } else if end > 20 {
            let behind = ["00000010", "PT     2", "PKT00010", "$", "A1", "5"];
            let mark = self.pick(&behind);
            text.insert_str(end, &format!("{}{mark}", " ".repeat(72 - end.min(72))));
        }
    }
}

impl Iterator for FuzzedStatements {
    type Item = Vec<u8>;

    fn next(&mut self) -> Option<Vec<u8>> {
        let mut text = String::new();
        // The first words are the plain ones.
        let word = if self.one_in(3) { self.pick(WORDS) } else { self.pick(&WORDS[..29]) };
        text.push_str(word);
        if !self.one_in(8) {
            text.push('/');
            let most = if self.one_in(4) { 12 } else { 6 };
            let fields = 1 + self.below(most);
            for index in 0..fields {
                if index > 0 {
                    text.push_str(if self.one_in(30) {
                        self.pick(&[" ", "", ", ", " ,", ",,", "/"])
                    } else {
                        ","
                    });
                    if self.one_in(12) {
                        text.push_str(self.pick(BREAKS));
                    }
                }
                self.push_field(&mut text);
            }
        }
        if self.one_in(2) {
            text.push('\n')
        } else {
            text.push_str(self.pick(ENDS))
        }
        if self.one_in(6) {
            self.fill_columns(&mut text);
        }
        let mut bytes = text.into_bytes();
        if self.one_in(12) && !bytes.is_empty() {
            let at = self.below(bytes.len());
            bytes[at] = self.below(256) as u8;
        }
        Some(bytes)
    }
}
