//! This module writes JSON that is indented at the top levels and on one line below, so that a polygon of a
//! hundred points does not take a hundred lines.

use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter};
use std::io::{self, Write};

/// Lists and objects that are nested deeper than this are on one line: those inside a layer.
const DEEPEST: usize = 5;

/// A formatter that indents down to a depth.
#[derive(Default)]
pub(super) struct DepthLimitedFormatter {
    pretty: PrettyFormatter<'static>,
    compact: CompactFormatter,
    depth: usize,
}

// Defines the methods of `Formatter` that pass on to one of the two formatters. `$step` is the change of
// depth: an opening bracket counts before it is written, a closing one after it.
macro_rules! by_depth {
    ($($name:ident($($argument:ident: $type:ty),*) $step:literal;)*) => {
        $(fn $name<W: ?Sized + Write>(&mut self, writer: &mut W, $($argument: $type),*) -> io::Result<()> {
            if $step > 0 {
                self.depth += 1;
            }
            let indented = self.depth <= DEEPEST;
            if $step < 0 {
                self.depth -= 1;
            }
            if indented { self.pretty.$name(writer, $($argument),*) } else { self.compact.$name(writer, $($argument),*) }
        })*
    };
}

impl Formatter for DepthLimitedFormatter {
    by_depth! {
        begin_array() 1;
        end_array() -1;
        begin_array_value(first: bool) 0;
        end_array_value() 0;
        begin_object() 1;
        end_object() -1;
        begin_object_key(first: bool) 0;
        begin_object_value() 0;
        end_object_value() 0;
    }
}
