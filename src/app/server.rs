//! A server for pages that only this machine sees.
//!
//! It listens on the loopback address, and answers requests only if their `Host` names this machine, so that a page
//! elsewhere cannot reach it by a name of its own (DNS rebinding). The port in `Host` is free: it differs behind a
//! tunnel. The first part of a path is a secret token, which the program prints: other users of this machine do not know
//! it, unless it is an option of the program, which they can list; and neither does a page elsewhere that sends a form
//! here, whose `Origin` is refused besides. Each connection carries one request, and must be done with it in a limited
//! time; streams of events last, as long as their readers read.
//!
//! HTTP itself is hyper's, on one thread beside those of the handlers that may wait.

use http_body_util::{BodyExt, Either, Full, LengthLimitError, Limited};
use hyper::body::{Body, Bytes, Frame, Incoming};
use hyper::header::{self, HeaderMap, HeaderName, HeaderValue};
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use std::convert::Infallible;
use std::io;
use std::net::TcpListener;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::thread;
use std::time::Duration;
use tokio::net::TcpStream;
use tokio::sync::{Semaphore, mpsc, oneshot, watch};
use tokio::task::spawn_blocking;
use tokio::time::{sleep, timeout};

/// Names of this machine in `Host`.
const HOSTS: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];
/// Headers of every response.
const HEADERS: [(HeaderName, &str); 5] = [
    (header::CACHE_CONTROL, "no-store"),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    // The token is in the address.
    (header::REFERRER_POLICY, "no-referrer"),
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; connect-src 'self'; img-src 'self' data:; script-src 'self'; style-src 'self'; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
];

/// The header of a numbered answer.
const PICTURE_NUMBER: HeaderName = HeaderName::from_static("picture-number");

/// Most threads for handlers of `POST`; more requests wait for one of them.
const BLOCKING_THREADS: usize = 8;

/// Limits of a server.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Connections at once; more wait for one of them to end.
    pub(crate) connections: usize,
    /// Streams of events at once, of the connections.
    pub(crate) streams: usize,
    /// Time for the head of a request to arrive.
    pub(crate) head: Duration,
    /// Time for a response, or for one event, to be transferred.
    pub(crate) transfer: Duration,
    /// Interval of messages in a stream without events, which reveal that its reader has gone.
    pub(crate) still_here: Duration,
    /// Length of the head of a request in bytes.
    pub(crate) head_bytes: usize,
    /// Length of the body of a request in bytes.
    pub(crate) body_bytes: usize,
}

impl Default for Limits {
    /// A browser takes a few connections for each page, and a request of this machine milliseconds.
    fn default() -> Self {
        Limits {
            connections: 128,
            streams: 64,
            head: Duration::from_secs(3),
            transfer: Duration::from_secs(10),
            still_here: Duration::from_secs(5),
            head_bytes: 16 << 10,
            body_bytes: 64 << 10,
        }
    }
}

/// The answer of a route.
pub(crate) enum Answer {
    /// Contents of a media type.
    Content(&'static str, Bytes),
    /// The same with a number that the page knows them by.
    Numbered(u64, &'static str, Bytes),
    /// A stream of server-sent events: the current text, which has no line breaks, and each later one.
    Events(watch::Receiver<String>),
    /// Nothing, as all is done.
    Done,
    /// Nothing, for a reason.
    Refusal(StatusCode, String),
}

/// A request for a route.
pub(crate) struct Call<'a> {
    /// The query of the address; empty without one.
    pub(crate) query: &'a str,
    /// The body; empty but for `POST`.
    pub(crate) body: &'a [u8],
}

/// A path with its method and its handler. Handlers of `GET` run on the thread of the server, so they return at once;
/// those of `POST` have threads of their own.
pub(crate) struct Route {
    method: Method,
    path: &'static str,
    handler: Box<dyn Fn(&Call<'_>) -> Answer + Send + Sync>,
}

impl Route {
    /// A route for `GET` and `HEAD`; the path is that behind the token.
    pub(crate) fn get(
        path: &'static str,
        handler: impl Fn(&Call<'_>) -> Answer + Send + Sync + 'static,
    ) -> Self {
        Route {
            method: Method::GET,
            path,
            handler: Box::new(handler),
        }
    }

    /// A route for `POST`.
    pub(crate) fn post(
        path: &'static str,
        handler: impl Fn(&Call<'_>) -> Answer + Send + Sync + 'static,
    ) -> Self {
        Route {
            method: Method::POST,
            ..Route::get(path, handler)
        }
    }

    /// The methods of the route, as `Allow` lists them.
    fn allowed(&self) -> &'static str {
        match self.method {
            Method::POST => "POST",
            _ => "GET, HEAD",
        }
    }
}

/// A secret of 128 bits in hexadecimal digits, from the random numbers of the system.
///
/// # Errors
/// When the system has none.
pub(crate) fn token() -> io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// Serves the routes below the token for as long as the process lives.
///
/// # Errors
/// When the system has no more threads or events.
pub(crate) fn serve(
    listener: TcpListener,
    token: &str,
    routes: Vec<Route>,
    limits: Limits,
) -> io::Result<()> {
    listener.set_nonblocking(true)?;
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_io()
        .enable_time()
        .max_blocking_threads(BLOCKING_THREADS)
        .build()?;
    let server = Arc::new(Server {
        prefix: format!("/{token}"),
        routes: routes.into_iter().map(Arc::new).collect(),
        streams: Arc::new(Semaphore::new(limits.streams)),
        limits,
    });
    let work = move || runtime.block_on(server.accept(listener));
    thread::Builder::new()
        .name("server".to_owned())
        .spawn(work)
        .map(drop)
}

struct Server {
    /// The first part of all paths.
    prefix: String,
    routes: Vec<Arc<Route>>,
    limits: Limits,
    streams: Arc<Semaphore>,
}

/// Events for one reader.
struct Events(mpsc::Receiver<Bytes>);

impl Body for Events {
    type Data = Bytes;
    type Error = Infallible;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
        let event = self.0.poll_recv(context);
        event.map(|event| event.map(|event| Ok(Frame::data(event))))
    }
}

type Reply = Response<Either<Full<Bytes>, Events>>;

/// The state of a connection.
struct Connection {
    server: Arc<Server>,
    /// Receives the channel on which a stream of events reports that its reader does not read.
    streams: mpsc::Sender<oneshot::Receiver<()>>,
}

impl Server {
    async fn accept(self: Arc<Self>, listener: TcpListener) {
        // It is a listening socket, and within the runtime.
        let Ok(listener) = tokio::net::TcpListener::from_std(listener) else {
            return;
        };
        let connections = Arc::new(Semaphore::new(self.limits.connections));
        loop {
            let Ok(permit) = Arc::clone(&connections).acquire_owned().await else {
                return;
            };
            let Ok((stream, _)) = listener.accept().await else {
                // Too many files are open: wait for some to be closed.
                sleep(Duration::from_millis(50)).await;
                continue;
            };
            let server = Arc::clone(&self);
            tokio::spawn(async move {
                server.connection(stream).await;
                drop(permit);
            });
        }
    }

    /// Serves a connection until its end or its deadline.
    async fn connection(self: Arc<Self>, stream: TcpStream) {
        let limits = self.limits;
        let (streams, mut stream_begun) = mpsc::channel(1);
        let connection = Connection {
            server: self,
            streams,
        };
        let mut http = hyper::server::conn::http1::Builder::new();
        http.keep_alive(false)
            .timer(TokioTimer::new())
            .header_read_timeout(limits.head)
            .max_buf_size(limits.head_bytes);
        let service = hyper::service::service_fn(|request: Request<Incoming>| {
            let connection = &connection;
            async move { Ok::<_, Infallible>(connection.reply(request).await) }
        });
        let serving = http.serve_connection(TokioIo::new(stream), service);
        let deadline = async {
            let begun = timeout(limits.head + limits.transfer, stream_begun.recv());
            if let Ok(Some(stalled)) = begun.await {
                // An error means that the stream has ended.
                let _ = stalled.await;
            }
        };
        // A closed connection gets no answer.
        tokio::select! {
            _ = serving => {}
            () = deadline => {}
        }
    }
}

impl Connection {
    async fn reply(&self, request: Request<Incoming>) -> Reply {
        let mut reply = self.reply_without_headers(request).await;
        for (name, value) in HEADERS {
            let value = HeaderValue::from_static(value);
            reply.headers_mut().insert(name, value);
        }
        reply
    }

    async fn reply_without_headers(&self, request: Request<Incoming>) -> Reply {
        let (head, body) = request.into_parts();
        if !is_for_this_machine(&head.headers) {
            return refusal(StatusCode::FORBIDDEN, "not this host");
        }
        if !is_from_this_page(&head.headers) {
            return refusal(StatusCode::FORBIDDEN, "not from a page elsewhere");
        }
        let Some(path) = head.uri.path().strip_prefix(&self.server.prefix) else {
            return refusal(StatusCode::NOT_FOUND, "nothing here");
        };
        let mut routes = self.server.routes.iter();
        let Some(route) = routes.find(|route| route.path == path).map(Arc::clone) else {
            return refusal(StatusCode::NOT_FOUND, "nothing here");
        };
        let is_head = head.method == Method::HEAD && route.method == Method::GET;
        if !is_head && head.method != route.method {
            let mut reply = refusal(StatusCode::METHOD_NOT_ALLOWED, "not this method");
            let allowed = HeaderValue::from_static(route.allowed());
            reply.headers_mut().insert(header::ALLOW, allowed);
            return reply;
        }
        let may_wait = route.method == Method::POST;
        let body = match route.method {
            Method::POST => {
                let most = self.server.limits.body_bytes;
                match Limited::new(body, most).collect().await {
                    Ok(body) => body.to_bytes(),
                    Err(fault) if fault.is::<LengthLimitError>() => {
                        return refusal(StatusCode::PAYLOAD_TOO_LARGE, "the body is too large");
                    }
                    Err(fault) => return refusal(StatusCode::BAD_REQUEST, fault.to_string()),
                }
            }
            _ if body.is_end_stream() => Bytes::new(),
            _ => return refusal(StatusCode::BAD_REQUEST, "no body is expected"),
        };
        let handle = move || {
            (route.handler)(&Call {
                query: head.uri.query().unwrap_or_default(),
                body: &body,
            })
        };
        let answer = match may_wait {
            true => spawn_blocking(handle).await.unwrap_or_else(|_| {
                let reason = "internal error: please report it".to_owned();
                Answer::Refusal(StatusCode::INTERNAL_SERVER_ERROR, reason)
            }),
            false => handle(),
        };
        match answer {
            Answer::Done => response(StatusCode::NO_CONTENT, PLAIN, Either::Left(Full::default())),
            Answer::Content(kind, bytes) => {
                response(StatusCode::OK, kind, Either::Left(bytes.into()))
            }
            Answer::Numbered(number, kind, bytes) => {
                let mut reply = response(StatusCode::OK, kind, Either::Left(bytes.into()));
                reply.headers_mut().insert(PICTURE_NUMBER, number.into());
                reply
            }
            Answer::Refusal(status, reason) => refusal(status, reason),
            Answer::Events(_) if is_head => {
                response(StatusCode::OK, EVENTS, Either::Left(Full::default()))
            }
            Answer::Events(events) => self.stream(events),
        }
    }

    /// A stream of events; a reader that does not take one in time ends the connection.
    fn stream(&self, mut events: watch::Receiver<String>) -> Reply {
        let limits = self.server.limits;
        let Ok(permit) = Arc::clone(&self.server.streams).try_acquire_owned() else {
            return refusal(StatusCode::SERVICE_UNAVAILABLE, "too many pages");
        };
        let (stall, stalled) = oneshot::channel();
        let (sender, frames) = mpsc::channel(1);
        // A connection has one request.
        let _ = self.streams.try_send(stalled);
        tokio::spawn(async move {
            let _permit = permit;
            loop {
                let event = format!("data: {}\n\n", *events.borrow_and_update());
                let sent = timeout(limits.transfer, sender.send(event.into())).await;
                match sent {
                    Ok(Ok(())) => {}
                    Ok(Err(_)) => return,
                    Err(_) => break,
                }
                tokio::select! {
                    () = sender.closed() => return,
                    changed = timeout(limits.still_here, events.changed()) => {
                        if let Ok(Err(_)) = changed {
                            return;
                        }
                    }
                }
            }
            let _ = stall.send(());
        });
        response(StatusCode::OK, EVENTS, Either::Right(Events(frames)))
    }
}

/// The media type of a stream of events.
const EVENTS: &str = "text/event-stream";
/// The media type of a text.
const PLAIN: &str = "text/plain; charset=utf-8";

/// True if the request is for this machine by one of its own names.
fn is_for_this_machine(headers: &HeaderMap) -> bool {
    let mut hosts = headers.get_all(header::HOST).iter();
    let (Some(host), None) = (hosts.next(), hosts.next()) else {
        return false;
    };
    let host = host.to_str().unwrap_or_default().to_ascii_lowercase();
    let is_port = |port: &str| {
        port.is_empty()
            || port.bytes().all(|byte| byte.is_ascii_digit()) && port.parse::<u16>().is_ok()
    };
    HOSTS.iter().any(|name| match host.strip_prefix(name) {
        Some("") => true,
        Some(rest) => rest.strip_prefix(':').is_some_and(is_port),
        None => false,
    })
}

/// True for a request of a page of this server, or of no page.
fn is_from_this_page(headers: &HeaderMap) -> bool {
    let mut origins = headers.get_all(header::ORIGIN).iter();
    match (origins.next(), origins.next(), headers.get(header::HOST)) {
        (None, ..) => true,
        (Some(origin), None, Some(host)) => {
            origin.as_bytes().strip_prefix(b"http://") == Some(host.as_bytes())
        }
        _ => false,
    }
}

fn refusal(status: StatusCode, reason: impl Into<Bytes>) -> Reply {
    response(status, PLAIN, Either::Left(Full::from(reason.into())))
}

fn response(status: StatusCode, kind: &'static str, body: Either<Full<Bytes>, Events>) -> Reply {
    let mut response = Response::new(body);
    *response.status_mut() = status;
    let kind = HeaderValue::from_static(kind);
    response.headers_mut().insert(header::CONTENT_TYPE, kind);
    response
}

#[cfg(test)]
mod tests;
