//! The picture on a page of this machine: a small server for a local browser.
//!
//! It listens on the loopback address only, answers only requests with this address as their host (so that another page
//! cannot reach it by a name of its own), and serves three paths: `/`, `/picture.png`, and `/events`, a stream of
//! server-sent events.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use super::shown::{Shown, State};

/// Connections at once: a browser takes a few.
const MOST: usize = 32;
/// Maximum length of the head of a request in bytes.
const LONGEST: u64 = 16 << 10;
/// Time limit for a request to arrive.
const PATIENCE: Duration = Duration::from_secs(10);
/// Interval of keep-alive messages, without which a closed connection would go unnoticed.
const STILL_HERE: Duration = Duration::from_secs(5);

const PAGE: &str = include_str!("page.html");

/// Serves for as long as the process lives.
pub(super) fn serve(listener: TcpListener, shown: Arc<Shown>, title: String) -> io::Result<()> {
    let server = Server {
        hosts: hosts(listener.local_addr()?.port()),
        page: PAGE.replace("TITLE", &escaped(&title)),
        shown,
        open: AtomicUsize::new(0),
    };
    let server = Arc::new(server);
    thread::Builder::new()
        .name("page".to_owned())
        .spawn(move || server.accept(&listener))
        .map(drop)
}

struct Server {
    /// Accepted values of the `Host` header.
    hosts: [String; 2],
    page: String,
    shown: Arc<Shown>,
    open: AtomicUsize,
}

fn hosts(port: u16) -> [String; 2] {
    ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"))
}

impl Server {
    fn accept(self: &Arc<Self>, listener: &TcpListener) {
        for stream in listener.incoming().flatten() {
            if self.open.fetch_add(1, Ordering::Relaxed) >= MOST {
                self.open.fetch_sub(1, Ordering::Relaxed);
                continue;
            }
            let server = Arc::clone(self);
            let answering = thread::Builder::new().spawn(move || {
                // A closed connection gets no answer.
                let _ = server.answer(stream);
                server.open.fetch_sub(1, Ordering::Relaxed);
            });
            if answering.is_err() {
                self.open.fetch_sub(1, Ordering::Relaxed);
            }
        }
    }

    fn answer(&self, mut stream: TcpStream) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        let (path, host) = parse_request(&stream)?;
        if !self.hosts.contains(&host) {
            return respond(&mut stream, "403 Forbidden", "text/plain", b"not this host");
        }
        match path.split('?').next() {
            Some("/") => {
                let kind = "text/html; charset=utf-8";
                respond(&mut stream, "200 OK", kind, self.page.as_bytes())
            }
            Some("/picture.png") => match self.shown.now().picture {
                Some(picture) => respond(&mut stream, "200 OK", "image/png", &picture.png),
                None => respond(
                    &mut stream,
                    "404 Not Found",
                    "text/plain",
                    b"no picture yet",
                ),
            },
            Some("/events") => self.stream_events(&mut stream),
            _ => respond(&mut stream, "404 Not Found", "text/plain", b"nothing here"),
        }
    }

    /// Sends every change, as long as the connection is open.
    fn stream_events(&self, stream: &mut TcpStream) -> io::Result<()> {
        stream.write_all(
            b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
        )?;
        let mut state = self.shown.now();
        loop {
            stream.write_all(format!("data: {}\n\n", state_json(&state)).as_bytes())?;
            stream.flush()?;
            let number = state.number;
            state = self.shown.after(number, STILL_HERE);
        }
    }
}

/// The JSON of a state for the page.
fn state_json(state: &State) -> String {
    let picture = state.picture.as_ref();
    serde_json::json!({
        "number": state.number,
        "errors": state.errors,
        "is_preview": picture.is_some_and(|picture| picture.is_preview),
        "seconds": picture.map(|picture| picture.seconds),
        "width": picture.map(|picture| picture.size.0),
        "height": picture.map(|picture| picture.size.1),
    })
    .to_string()
}

/// The path and the host of a request.
fn parse_request(stream: &TcpStream) -> io::Result<(String, String)> {
    let mut lines = BufReader::new(stream.take(LONGEST)).lines();
    let malformed = || io::Error::from(io::ErrorKind::InvalidData);
    let first = lines.next().ok_or_else(malformed)??;
    let mut words = first.split(' ');
    let (Some("GET"), Some(path)) = (words.next(), words.next()) else {
        return Err(malformed());
    };
    let mut host = String::new();
    for line in lines {
        let line = line?;
        match line.split_once(':') {
            Some((name, value)) if name.eq_ignore_ascii_case("host") => {
                host = value.trim().to_ascii_lowercase();
            }
            _ if line.is_empty() => break,
            _ => {}
        }
    }
    Ok((path.to_owned(), host))
}

fn respond(stream: &mut TcpStream, status: &str, kind: &str, body: &[u8]) -> io::Result<()> {
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\nCache-Control: no-store\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body)?;
    stream.flush()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
