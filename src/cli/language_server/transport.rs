//! This module reads and writes messages of the protocol. What is no message is answered with an error or passed over; only
//! the end of the input ends the reading.

use lsp_server::{ErrorCode, Message, Notification, Request, RequestId};
use serde::Deserialize;
use serde_json::{Value, json};
use std::io::{self, BufRead, Read, Write};

/// No message is longer: the text of a file of 4 GiB is refused everywhere else as well.
const LONGEST_MESSAGE: u64 = 4 << 30;

/// No line of a header is longer.
const LONGEST_LINE: u64 = 8 << 10;

/// What was read.
#[derive(Debug)]
pub(super) enum Received {
    Message(Message),
    /// The answer to a request of the server.
    Answer,
    /// Bytes that are no message; the value is the answer to them.
    Refused(Value),
    End,
}

/// Reads the next message.
///
/// # Errors
/// Returns the errors of the input.
pub(super) fn read_message(input: &mut impl BufRead) -> io::Result<Received> {
    let Some(length) = read_header(input)? else { return Ok(Received::End) };
    if length > LONGEST_MESSAGE {
        io::copy(&mut input.by_ref().take(length), &mut io::sink())?;
        return Ok(Received::Refused(refuse(ErrorCode::InvalidRequest, "the message is too long")));
    }
    // Memory is taken as bytes arrive, so a length that only claims to be large takes none.
    let mut body = Vec::new();
    if input.by_ref().take(length).read_to_end(&mut body)? < length as usize {
        return Ok(Received::End);
    }
    Ok(match serde_json::from_slice::<MessageText>(&body) {
        Ok(MessageText { id: Some(id), method: Some(method), params }) => {
            Received::Message(Message::Request(Request { id, method, params }))
        }
        Ok(MessageText { id: None, method: Some(method), params }) => {
            Received::Message(Message::Notification(Notification { method, params }))
        }
        // Nothing depends on what the editor answers.
        Ok(MessageText { id: Some(_), method: None, .. }) => Received::Answer,
        Ok(MessageText { id: None, method: None, .. }) => Received::Refused(refuse(
            ErrorCode::InvalidRequest,
            "a message has a method or answers a request",
        )),
        Err(error) if error.is_data() => {
            Received::Refused(refuse(ErrorCode::InvalidRequest, &error.to_string()))
        }
        Err(error) => Received::Refused(refuse(ErrorCode::ParseError, &error.to_string())),
    })
}

/// A message of any kind. It is read at once, because the text of a long program should be there once and not in parts of
/// a message that are looked at first.
#[derive(Deserialize)]
struct MessageText {
    id: Option<RequestId>,
    method: Option<String>,
    #[serde(default)]
    params: Value,
}

/// Reads lines until an empty one and returns the length that they state; lines that state none are passed over.
fn read_header(input: &mut impl BufRead) -> io::Result<Option<u64>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        if input.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        match (line.trim(), length) {
            ("", Some(length)) => return Ok(Some(length)),
            (line, _) => {
                let stated =
                    line.split_once(':').filter(|(name, _)| name.eq_ignore_ascii_case("content-length"));
                length = stated.and_then(|(_, value)| value.trim().parse().ok()).or(length);
            }
        }
    }
}

fn refuse(code: ErrorCode, message: &str) -> Value {
    json!({ "jsonrpc": "2.0", "id": null, "error": { "code": code as i32, "message": message } })
}

/// Writes a message.
///
/// # Errors
/// Returns the errors of the output.
pub(super) fn write_message(out: &mut impl Write, message: &Value) -> io::Result<()> {
    let body = serde_json::to_vec(message).map_err(io::Error::from)?;
    write!(out, "Content-Length: {}\r\n\r\n", body.len())?;
    out.write_all(&body)?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read_all(bytes: &[u8]) -> Vec<Received> {
        let mut input = io::Cursor::new(bytes);
        let mut all = Vec::new();
        loop {
            match read_message(&mut input).unwrap() {
                Received::End => return all,
                received => all.push(received),
            }
        }
    }

    #[test]
    fn what_is_no_message_is_passed_over() {
        let good = b"Content-Length: 37\r\n\r\n{\"jsonrpc\":\"2.0\",\"method\":\"exit\"    }";
        let mut bytes = b"nonsense\r\n\r\nContent-Length: 4\r\n\r\n{{{{Content-Length: 2\r\n\r\n[]".to_vec();
        bytes.extend_from_slice(good);
        bytes.extend_from_slice(b"Content-Length: 38\r\n\r\n{\"jsonrpc\":\"2.0\",\"id\":1,\"result\":{}  }");
        bytes.extend_from_slice(b"Content-Length: 2\r\n\r\n{}");
        let all = read_all(&bytes);
        assert!(
            matches!(
                all[..],
                [
                    Received::Refused(_),
                    Received::Refused(_),
                    Received::Message(_),
                    Received::Answer,
                    Received::Refused(_)
                ]
            ),
            "{all:?}"
        );
    }

    #[test]
    fn a_length_that_nothing_follows_is_the_end() {
        assert!(read_all(b"Content-Length: 4000000000\r\n\r\nabc").is_empty());
        assert!(read_all(b"Content-Length: 99999999999999999999999\r\n\r\nabc").is_empty());
    }
}
