//! The live page: the picture, its events and the wishes of its viewers, below a secret path.

use super::shown::Shown;
use super::source::SceneText;
use super::wishes::{Change, Wishes};
use crate::app::server::{Answer, Call, Limits, Route, serve as serve_routes};
use hyper::StatusCode;
use std::io;
use std::net::TcpListener;
use std::sync::Arc;

const PAGE: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
const SCRIPT: &str = include_str!("page/page.js");

/// Serves for as long as the process lives.
///
/// # Errors
/// When the system has no more threads.
pub(super) fn serve(
    listener: TcpListener,
    token: &str,
    (shown, wishes): (&Arc<Shown>, &Arc<Wishes>),
) -> io::Result<()> {
    let events = shown.events();
    let picture = Arc::clone(shown);
    let history = Arc::clone(shown);
    let overlay = Arc::clone(shown);
    let (text, scenes, thumbnails) = (Arc::clone(wishes), Arc::clone(wishes), Arc::clone(wishes));
    let (changed, wishes) = (Arc::clone(shown), Arc::clone(wishes));
    let routes = vec![
        Route::get("/", |_| {
            Answer::Content("text/html; charset=utf-8", PAGE.into())
        }),
        Route::get("/scenes.json", move |_| {
            Answer::Content("application/json", scenes.scenes.json().into())
        }),
        Route::get("/thumbnail.png", move |call| {
            png(call
                .query
                .parse()
                .ok()
                .and_then(|number| thumbnails.scenes.thumbnail(number)))
        }),
        Route::get("/page.css", |_| Answer::Content("text/css", STYLE.into())),
        Route::get("/page.js", |_| {
            Answer::Content("text/javascript; charset=utf-8", SCRIPT.into())
        }),
        Route::get("/picture.png", move |_| match picture.numbered_png() {
            Some((number, png)) => Answer::Numbered(number, "image/png", png),
            None => Answer::Done,
        }),
        Route::get("/overlay.png", move |_| png(overlay.overlay_png())),
        Route::get("/history.png", move |call| {
            png(call
                .query
                .parse()
                .ok()
                .and_then(|number| history.earlier(number)))
        }),
        Route::get("/scene.pov", move |call| {
            scene(call, &text.current().source)
        }),
        Route::get("/events", move |_| Answer::Events(events.clone())),
        Route::post("/change", move |call| change(call, &wishes, &changed)),
    ];
    serve_routes(listener, token, routes, Limits::default())
}

/// A picture; nothing where there is none yet, or no longer, of which the page learns with the next event.
fn png(png: Option<hyper::body::Bytes>) -> Answer {
    png.map_or(Answer::Done, |png| Answer::Content("image/png", png))
}

/// The text of the number in the query; nothing if that is not the current one, of which the page learns
/// with the next event.
fn scene(call: &Call<'_>, source: &SceneText) -> Answer {
    match &source.text {
        _ if call.query.parse() != Ok(source.number) => Answer::Done,
        Some(text) => Answer::Content("text/plain; charset=utf-8", text.clone().into()),
        None => Answer::Refusal(
            StatusCode::NOT_FOUND,
            "it is not a text in UTF-8".to_owned(),
        ),
    }
}

/// Applies the change in the body of a request.
fn change(call: &Call<'_>, wishes: &Wishes, shown: &Shown) -> Answer {
    let change: Change = match serde_json::from_slice(call.body) {
        Ok(change) => change,
        Err(error) => return Answer::Refusal(StatusCode::BAD_REQUEST, error.to_string()),
    };
    // A moved camera is shown with its picture.
    let is_shown = !matches!(change, Change::Move(_) | Change::Cursor(_));
    match wishes.apply(change) {
        Ok(()) => {
            if is_shown {
                shown.refresh();
            }
            Answer::Done
        }
        Err(reason) => Answer::Refusal(StatusCode::CONFLICT, reason),
    }
}
