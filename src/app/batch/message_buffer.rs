//! What was said while a picture was drawn beside others, kept until it is its turn.

use std::sync::{Mutex, PoisonError};

use crate::base::options::Event;
use crate::base::source::Message;

/// Events in their order.
#[derive(Debug, Default)]
pub struct MessageBuffer {
    all: Mutex<Vec<BufferedEvent>>,
}

#[derive(Debug)]
enum BufferedEvent {
    Said(String),
    Found(Box<Message>),
}

impl MessageBuffer {
    /// Keeps what is said and found.
    pub fn hear(&self, event: Event<'_>) {
        let heard = match event {
            Event::Said(text) => BufferedEvent::Said(text.to_owned()),
            Event::Found(message) => BufferedEvent::Found(Box::new(message.clone())),
            _ => return,
        };
        let mut all = self.all.lock().unwrap_or_else(PoisonError::into_inner);
        // A scene that says a character at a time says one text.
        match (all.last_mut(), heard) {
            (Some(BufferedEvent::Said(before)), BufferedEvent::Said(text)) => {
                before.push_str(&text)
            }
            (_, heard) => all.push(heard),
        }
    }

    /// Tells all of it.
    pub fn tell(self, listen: impl Fn(Event<'_>)) {
        let all = self.all.into_inner();
        for heard in all.unwrap_or_else(PoisonError::into_inner) {
            match &heard {
                BufferedEvent::Said(text) => listen(Event::Said(text)),
                BufferedEvent::Found(message) => listen(Event::Found(message)),
            }
        }
    }
}
