//! The picture on a page of this machine, at three paths: `/`, `/picture.png`, and `/events`.

use super::shown::Shown;
use crate::app::server::{Answer, Limits, Route, serve as serve_routes};
use hyper::StatusCode;
use std::io;
use std::net::TcpListener;
use std::sync::Arc;

const PAGE: &str = include_str!("page.html");

/// Serves for as long as the process lives.
///
/// # Errors
/// When the system has no more threads.
pub(super) fn serve(listener: TcpListener, shown: &Arc<Shown>, title: &str) -> io::Result<()> {
    let page = PAGE.replace("TITLE", &escaped(title));
    let events = shown.events();
    let shown = Arc::clone(shown);
    let routes = vec![
        Route::new("/", move || {
            Answer::Content("text/html; charset=utf-8", page.clone().into())
        }),
        Route::new("/picture.png", move || match shown.png() {
            Some(png) => Answer::Content("image/png", png),
            None => Answer::Refusal(StatusCode::NOT_FOUND, "no picture yet"),
        }),
        Route::new("/events", move || Answer::Events(events.clone())),
    ];
    serve_routes(listener, routes, Limits::default())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
