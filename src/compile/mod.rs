//! From the description of a scene to the world that rays need.

pub mod world;

pub use world::{
    Departure, Flags, Globals, Hit, InteriorId, Query, Scratch, Seen, Solid, Surface, World,
};
