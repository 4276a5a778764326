//! Debian's Chromium, headless.

use std::path::Path;
use std::process::Command;

/// The browser, if there is one.
pub(crate) fn browser() -> Option<&'static str> {
    ["chromium", "chromium-browser", "google-chrome"]
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok())
}

/// Windows in which pages are tested: width in pixels, and colours.
pub(crate) const WINDOWS: [(u32, Scheme); 4] = [
    (1400, Scheme::Light),
    (1400, Scheme::Dark),
    (420, Scheme::Light),
    (420, Scheme::Dark),
];

/// The colours that the user prefers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    Dark,
    Light,
}

/// Collects errors from the start of a page on.
const FAULTS: &str = "<script>window.faults = [];
addEventListener('error', event => faults.push(event.message));
addEventListener('unhandledrejection', event => faults.push(String(event.reason)));
console.error = (...words) => faults.push(words.join(' '));</script>";

/// Writes facts that hold for every page into attributes of the body: errors, sideways scrolling, the least contrast of
/// a text (WCAG 2.1, 1.4.3), and the number of resources that are not in the page.
const FACTS: &str = "<script>
function channels(color) {
  const context = document.createElement('canvas').getContext('2d');
  context.fillStyle = color;
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data];
}
function luminance([r, g, b]) {
  const linear = [r, g, b].map(c => c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}
function behind(element) {
  for (let at = element; at; at = at.parentElement) {
    const color = channels(getComputedStyle(at).backgroundColor);
    if (color[3] === 255) return color;
  }
  return channels(getComputedStyle(document.documentElement).colorScheme === 'dark' ? '#121212' : '#fff');
}
function contrast(element) {
  const [a, b] = [channels(getComputedStyle(element).color), behind(element)].map(luminance);
  return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
}
function facts() {
  const told = document.body.dataset;
  const texts = [...document.querySelectorAll('body *')].filter(one => one.checkVisibility() && !one.closest('svg, script, style')
    && [...one.childNodes].some(node => node.nodeType === 3 && node.textContent.trim()));
  const faint = texts.filter(one => contrast(one) < 4.5);
  told.faint = faint.map(one => `${one.tagName} ${one.textContent.slice(0, 20)} ${contrast(one).toFixed(2)}`).join('; ');
  told.texts = texts.length > 3;
  told.overflow = document.documentElement.scrollWidth > innerWidth;
  told.faults = faults.join('; ');
  told.elsewhere = performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:') && !e.name.startsWith('file:')).length;
  told.done = true;
}
</script>";

/// Attributes that every page must have.
pub(crate) const EVERY_PAGE: [&str; 6] = [
    "data-faint=\"\"",
    "data-texts=\"true\"",
    "data-overflow=\"false\"",
    "data-faults=\"\"",
    "data-elsewhere=\"0\"",
    "data-done=\"true\"",
];

/// Writes a copy of a page that runs `probe` once it is loaded: a script that writes what it sees into attributes of the
/// body. After it, `facts()` does so for [`EVERY_PAGE`].
pub(crate) fn write_probed(page: &Path, copy: &Path, probe: &str) {
    let text = std::fs::read_to_string(page).expect("a page");
    let text = text.replacen("<head>", &format!("<head>{FAULTS}"), 1);
    let script = format!(
        "{FACTS}<script>addEventListener('load', () => setTimeout(async () => {{ const told = document.body.dataset;\n\
         {probe}\nfacts(); }}, 300));</script></body>"
    );
    std::fs::write(copy, text.replace("</body>", &script)).expect("a page");
}

/// The document of a page after its scripts have run, in a window of this width.
pub(crate) fn shown(browser: &str, page: &Path, width: u32, scheme: Scheme) -> String {
    let profile = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(browser);
    command
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .arg(format!(
            "--blink-settings=preferredColorScheme={}",
            scheme as u8
        ))
        .arg(format!("--window-size={width},1000"))
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg("--virtual-time-budget=20000")
        .arg(format!("file://{}", page.display()));
    let output = command.output().expect("the browser starts");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Checks that the body of a dumped document has these attributes.
pub(crate) fn expect(dump: &str, facts: &[&str], window: (u32, Scheme)) {
    for fact in facts.iter().chain(&EVERY_PAGE) {
        let body = &dump[dump.find("<body").unwrap_or(0)..];
        let body: String = body.chars().take(1000).collect();
        assert!(dump.contains(fact), "{fact} at {window:?}: {body}");
    }
}
