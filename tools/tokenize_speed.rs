//! Speed of the lexer: `cargo run --release -p povr-tools --bin tokenize_speed -- FILE...`
//!
//! Without files it generates three texts: spheres with textures, the lists of a mesh, and a program of macros and
//! loops. Times are processor time where the system reports it, the best of five; their accuracy is ±20 %.

#![allow(clippy::print_stdout, reason = "the output is the purpose")]

use povr::base::source::FileId;
use povr::lang::syntax::{Names, tokenize};
use std::fmt::Write as _;
use std::sync::Arc;
use std::time::{Duration, Instant};

fn main() {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let texts: Vec<(String, Vec<Arc<String>>)> = if files.is_empty() {
        vec![
            ("spheres".into(), vec![spheres(160_000).into()]),
            ("mesh2".into(), vec![mesh(260_000).into()]),
            ("program".into(), vec![program(40_000).into()]),
        ]
    } else {
        let texts = files.iter().filter_map(|path| std::fs::read(path).ok());
        let texts = texts.map(|bytes| String::from_utf8_lossy(&bytes).into_owned().into());
        vec![(format!("{} files", files.len()), texts.collect())]
    };
    for (name, texts) in texts {
        report(&name, &texts);
    }
}

fn report(name: &str, texts: &[Arc<String>]) {
    let mut best = Duration::MAX;
    let mut count = 0;
    for _ in 0..5 {
        let clock = Clock::start();
        let mut names = Names::new();
        count = 0;
        for text in texts {
            match tokenize(FileId(0), text, &mut names) {
                Ok(tokens) => count += tokens.tokens.len(),
                Err(faults) => println!("{name}: {}", faults[0].message),
            }
        }
        best = best.min(clock.elapsed());
    }
    let bytes: usize = texts.iter().map(|text| text.len()).sum();
    let rate = f64::from(u32::try_from(bytes).unwrap_or(u32::MAX)) / best.as_secs_f64() / 1e6;
    println!("{name}: {bytes} bytes, {count} tokens, {best:.1?}, {rate:.0} MB/s");
}

/// Processor time of this thread; wall time where the system does not report it.
struct Clock {
    wall: Instant,
    processor: Option<Duration>,
}

impl Clock {
    fn start() -> Self {
        Clock {
            wall: Instant::now(),
            processor: processor_time(),
        }
    }

    fn elapsed(&self) -> Duration {
        let processor = processor_time().zip(self.processor);
        processor.map_or_else(|| self.wall.elapsed(), |(now, then)| now - then)
    }
}

fn processor_time() -> Option<Duration> {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds = times.split(' ').next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

fn spheres(count: u32) -> String {
    let mut text = String::new();
    for i in 0..count {
        let x = f64::from(i) * 0.137;
        writeln!(
            text,
            "sphere {{ <{x:.3}, {:.3}, -1.5>, 0.25\n  pigment {{ color rgb <0.8, {:.2}, 0.1> }}\n  \
             finish {{ ambient 0.1 diffuse 0.7 phong 0.5 }}\n}}",
            x.sin(),
            x.cos().abs()
        )
        .expect("strings grow");
    }
    text
}

fn mesh(count: u32) -> String {
    let mut text = format!("mesh2 {{\n  vertex_vectors {{ {count},\n");
    for i in 0..count {
        let x = f64::from(i) * 0.0137;
        writeln!(text, "    <{:.6}, {:.6}, {:.6}>,", x.sin(), x.cos(), x).expect("strings grow");
    }
    writeln!(text, "  }}\n  face_indices {{ {},", 2 * count).expect("strings grow");
    for i in 0..2 * count {
        writeln!(text, "    <{i}, {}, {}>,", i / 2, i / 2 + 7).expect("strings grow");
    }
    text.push_str("  }\n}\n");
    text
}

fn program(count: u32) -> String {
    let mut text = String::new();
    for i in 0..count {
        writeln!(
            text,
            "// leg number {i}\n#macro Leg_{i}(Angle, Length)\n  #local Knee = vrotate(Length*y, Angle*x);\n  \
             #if (Knee.y > {i}) cylinder {{ 0, Knee, Thick texture {{ Wood rotate 90*y }} }}\n  \
             #else #debug \"too short\\n\" #end\n#end\n"
        )
        .expect("strings grow");
    }
    text
}
