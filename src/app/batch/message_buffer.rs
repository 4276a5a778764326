//! Buffers the messages of pictures that are rendered in parallel, so that they are printed in order.

use std::sync::{Mutex, PoisonError};

use crate::base::options::Event;
use crate::base::source::Message;

/// Events in order.
#[derive(Debug, Default)]
pub struct MessageBuffer {
    all: Mutex<Vec<BufferedEvent>>,
}

#[derive(Debug)]
enum BufferedEvent {
    SceneOutput(String),
    Finding(Box<Message>),
}

impl MessageBuffer {
    /// Stores an event.
    pub fn push(&self, event: Event<'_>) {
        let buffered = match event {
            Event::SceneOutput(text) => BufferedEvent::SceneOutput(text.to_owned()),
            Event::Finding(message) => BufferedEvent::Finding(Box::new(message.clone())),
            _ => return,
        };
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        // Merges successive texts: a scene may print a character at a time.
        match (all.last_mut(), buffered) {
            (Some(BufferedEvent::SceneOutput(before)), BufferedEvent::SceneOutput(text)) => {
                before.push_str(&text)
            }
            (_, buffered) => all.push(buffered),
        }
    }

    /// Reports all events.
    pub fn replay(self, listen: impl Fn(Event<'_>)) {
        let all = self.all.into_inner();
        for buffered in all.unwrap_or_else(PoisonError::into_inner) {
            match &buffered {
                BufferedEvent::SceneOutput(text) => listen(Event::SceneOutput(text)),
                BufferedEvent::Finding(message) => listen(Event::Finding(message)),
            }
        }
    }
}
