use super::*;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Instant;

/// Limits that a test can wait for.
const SHORT: Limits = Limits {
    connections: 64,
    streams: 8,
    head: Duration::from_millis(700),
    transfer: Duration::from_millis(700),
    still_here: Duration::from_millis(50),
    head_bytes: 16 << 10,
    body_bytes: 1 << 10,
};
const TOKEN: &str = "secret";
/// More than the buffers of a connection hold.
const LARGE: usize = 64 << 20;

/// A server, and the events that it sends.
fn server(limits: Limits) -> (SocketAddr, watch::Sender<String>) {
    let (sender, events) = watch::channel("first".to_owned());
    let large = Bytes::from(vec![b'x'; LARGE]);
    let routes = vec![
        Route::get("/", |_| Answer::Content("text/html", "page".into())),
        Route::get("/large", move |_| {
            Answer::Content("text/plain", large.clone())
        }),
        Route::get("/events", move |_| Answer::Events(events.clone())),
        Route::post("/echo", |call| {
            Answer::Content("text/plain", call.body.to_vec().into())
        }),
    ];
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    serve(listener, TOKEN, routes, limits).unwrap();
    (address, sender)
}

fn sent(address: SocketAddr, request: &str) -> TcpStream {
    let mut stream = TcpStream::connect(address).unwrap();
    let limit = Some(Duration::from_secs(20));
    stream.set_read_timeout(limit).unwrap();
    stream.write_all(request.as_bytes()).unwrap();
    stream
}

/// The response to a request.
fn answered(address: SocketAddr, request: &str) -> String {
    let mut text = String::new();
    sent(address, request).read_to_string(&mut text).unwrap();
    text
}

fn get(path: &str, host: &str) -> String {
    format!("GET /{TOKEN}{path} HTTP/1.1\r\nHost: {host}\r\n\r\n")
}

#[test]
fn requests_have_their_answers() {
    let (address, _events) = server(SHORT);
    let page = answered(address, &get("/?a=1", "localhost"));
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n"), "{page}");
    assert!(page.ends_with("\r\n\r\npage"), "{page}");
    for (name, value) in [
        ("cross-origin-resource-policy", "same-origin"),
        ("x-content-type-options", "nosniff"),
        ("cache-control", "no-store"),
        ("content-length", "4"),
        ("content-type", "text/html"),
    ] {
        assert!(page.contains(&format!("\r\n{name}: {value}\r\n")), "{page}");
    }
    let head = answered(address, "HEAD /secret/ HTTP/1.1\r\nHost: localhost\r\n\r\n");
    assert!(head.contains("content-length: 4\r\n"), "{head}");
    assert!(head.ends_with("\r\n\r\n"), "{head}");
    let head = answered(
        address,
        "HEAD /secret/events HTTP/1.1\r\nHost: localhost\r\n\r\n",
    );
    assert!(head.ends_with("\r\n\r\n"), "{head}");
    let body = "Host: localhost\r\nContent-Length: 2\r\n\r\nab";
    let posted = answered(address, &format!("POST /secret/ HTTP/1.1\r\n{body}"));
    assert!(posted.contains("\r\nallow: GET, HEAD\r\n"), "{posted}");
    let chunked = "Host: localhost\r\nTransfer-Encoding: chunked\r\n\r\n";
    for (request, status) in [
        (&*format!("POST /secret/ HTTP/1.1\r\n{body}"), "405"),
        (&*format!("GET /secret/ HTTP/1.1\r\n{body}"), "400"),
        (&*format!("GET /secret/ HTTP/1.1\r\n{chunked}"), "400"),
        ("GET /../a HTTP/1.1\r\nHost: localhost\r\n\r\n", "404"),
        (
            "GET /secret/../a HTTP/1.1\r\nHost: localhost\r\n\r\n",
            "404",
        ),
        ("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n", "404"),
        ("nonsense\r\n\r\n", "400"),
    ] {
        let answer = answered(address, request);
        assert!(
            answer.starts_with(&format!("HTTP/1.1 {status} ")),
            "{request}: {answer}"
        );
    }
}

#[test]
fn only_the_names_of_this_machine_are_answered() {
    let (address, _events) = server(SHORT);
    let port = address.port();
    for (host, status) in [
        (format!("127.0.0.1:{port}"), "200"),
        ("LocalHost:9".to_owned(), "200"),
        ("[::1]".to_owned(), "200"),
        ("localhost:".to_owned(), "200"),
        ("localhost:+80".to_owned(), "403"),
        ("localhost:65536".to_owned(), "403"),
        (format!("evil.example:{port}"), "403"),
        ("localhost.evil.example".to_owned(), "403"),
        ("localhost:80@evil.example".to_owned(), "403"),
        ("127.0.0.1\r\nHost: evil.example".to_owned(), "403"),
        (String::new(), "403"),
    ] {
        let answer = answered(address, &get("/", &host));
        assert!(
            answer.starts_with(&format!("HTTP/1.1 {status} ")),
            "{host}: {answer}"
        );
    }
    let answer = answered(address, "GET / HTTP/1.0\r\n\r\n");
    assert!(answer.starts_with("HTTP/1.0 403 "), "{answer}");
}

/// The time until the server closes a connection.
fn time_to_end(mut stream: TcpStream) -> Duration {
    let start = Instant::now();
    // An error is an end as well.
    let _ = stream.read_to_end(&mut Vec::new());
    start.elapsed()
}

#[test]
fn bodies_are_limited_and_pages_elsewhere_refused() {
    let (address, _events) = server(SHORT);
    let post = |more: &str, body: &str| {
        let length = body.len();
        let head = format!("Host: localhost:8\r\n{more}Content-Length: {length}\r\n");
        answered(
            address,
            &format!("POST /{TOKEN}/echo HTTP/1.1\r\n{head}\r\n{body}"),
        )
    };
    let echoed = post("Origin: http://localhost:8\r\n", "abc");
    assert!(echoed.starts_with("HTTP/1.1 200 ") && echoed.ends_with("abc"));
    for (more, body, status) in [
        ("", "x".repeat(SHORT.body_bytes), "200"),
        ("", "x".repeat(SHORT.body_bytes + 1), "413"),
        ("Origin: http://evil.example\r\n", String::new(), "403"),
        ("Origin: null\r\n", String::new(), "403"),
        ("Origin: http://localhost:9\r\n", String::new(), "403"),
    ] {
        let answer = post(more, &body);
        assert!(
            answer.starts_with(&format!("HTTP/1.1 {status} ")),
            "{more}: {answer}"
        );
    }
    let head = "Host: localhost\r\nTransfer-Encoding: chunked\r\n";
    let request = format!("POST /{TOKEN}/echo HTTP/1.1\r\n{head}\r\nno length\r\n");
    let answer = answered(address, &request);
    assert!(answer.starts_with("HTTP/1.1 400 "), "{answer}");
    let answer = answered(address, &get("/echo", "localhost"));
    assert!(answer.contains("\r\nallow: POST\r\n"), "{answer}");
}

#[test]
fn tokens_differ() {
    let [a, b] = [token().unwrap(), token().unwrap()];
    assert!(a != b && a.len() == 32);
}

#[test]
fn slow_clients_are_dropped() {
    let (address, events) = server(SHORT);
    let limit = SHORT.head + SHORT.transfer + Duration::from_secs(5);
    // A byte now and then, each well within the time.
    let mut slow = sent(address, "");
    let start = Instant::now();
    while slow.write_all(b"G").is_ok() {
        assert!(start.elapsed() < limit, "a slow head is read to its end");
        thread::sleep(Duration::from_millis(50));
    }
    assert!(time_to_end(sent(address, "GET /")) < limit);
    // A reader of a large response that pauses.
    let mut slow = sent(address, &get("/large", "localhost"));
    let start = Instant::now();
    let mut piece = [0; 1024];
    let mut read = 0;
    while let Ok(length @ 1..) = slow.read(&mut piece) {
        read += length;
        if start.elapsed() < limit {
            thread::sleep(Duration::from_millis(20));
        }
    }
    assert!(read < LARGE);
    // A stream of events that nobody reads.
    let stream = sent(address, &get("/events", "localhost"));
    let start = Instant::now();
    while events.receiver_count() > 1 {
        assert!(
            start.elapsed() < 2 * limit,
            "a stream is sent that nobody reads"
        );
        events.send_replace("x".repeat(1 << 20));
        thread::sleep(Duration::from_millis(2));
    }
    drop(stream);
}

#[test]
fn idle_connections_do_not_keep_others_out() {
    let (address, _events) = server(SHORT);
    let idle: Vec<TcpStream> = (0..SHORT.connections).map(|_| sent(address, "")).collect();
    let start = Instant::now();
    let page = answered(address, &get("/", "localhost"));
    assert!(page.starts_with("HTTP/1.1 200 OK\r\n"), "{page}");
    assert!(start.elapsed() < SHORT.head + Duration::from_secs(5));
    drop(idle);
}

#[test]
fn every_viewer_receives_all_events() {
    let (address, events) = server(SHORT);
    let mut viewers: Vec<TcpStream> = (0..SHORT.streams)
        .map(|_| sent(address, &get("/events", "localhost")))
        .collect();
    let until = |viewer: &mut TcpStream, text: &str| {
        let mut seen = String::new();
        let mut piece = [0; 512];
        while !seen.contains(text) {
            let length = viewer.read(&mut piece).unwrap();
            assert_ne!(length, 0, "{seen}");
            seen.push_str(&String::from_utf8_lossy(&piece[..length]));
        }
    };
    for viewer in &mut viewers {
        until(viewer, "data: first\n\n");
    }
    let refused = answered(address, &get("/events", "localhost"));
    assert!(refused.starts_with("HTTP/1.1 503 "), "{refused}");
    events.send_replace("second".to_owned());
    for viewer in &mut viewers {
        until(viewer, "data: second\n\n");
    }
    // They last, and their number counts only the open ones.
    thread::sleep(SHORT.head + SHORT.transfer);
    events.send_replace("third".to_owned());
    for viewer in &mut viewers {
        until(viewer, "data: third\n\n");
    }
    drop(viewers);
    let start = Instant::now();
    while events.receiver_count() > 1 {
        assert!(start.elapsed() < Duration::from_secs(5));
        thread::sleep(Duration::from_millis(10));
    }
    until(
        &mut sent(address, &get("/events", "localhost")),
        "data: third\n\n",
    );
}
