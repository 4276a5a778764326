//! Self-contained HTML pages with one look: they need no network, and read well in light and dark, wide and narrow.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

/// The style that all pages share.
pub(crate) const STYLE: &str = include_str!("style.css");
/// The icon of a tab, for the head of a page.
pub(crate) const ICON: &str = "<link rel=\"icon\" href=\"data:image/svg+xml,\
    %3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E%3Ccircle cx='8' cy='8' r='7' fill='%23d8572a'/%3E\
    %3Ccircle cx='5.5' cy='5' r='2' fill='%23fff' opacity='.8'/%3E%3C/svg%3E\">";
/// The filter of a gallery, for a bar at the top.
pub(crate) const FILTER: &str = "<input type=\"search\" id=\"filter\" placeholder=\"filter by name or text\" \
    aria-label=\"filter\"><span class=\"quiet\" id=\"shown\"></span>";
/// The viewer of a gallery, for the end of a body. Its figures have an `id`, `a.shot` around each `img`, and a
/// `figcaption` that begins with the name in a `b`; the rest of that is shown below the picture. [`FILTER`] hides the
/// figures without its words, and groups `section.group` of such figures alone.
pub(crate) const GALLERY: &str = concat!(
    "<dialog aria-label=\"picture\"><div class=\"viewer\"><header><h2></h2>\
     <button id=\"previous\" title=\"left arrow\" aria-label=\"previous\">‹</button>\
     <button id=\"next\" title=\"right arrow\" aria-label=\"next\">›</button>\
     <button id=\"close\">close</button></header><div class=\"stage\"></div><footer></footer></div></dialog>\n\
     <script>\n",
    include_str!("gallery.js"),
    "</script>\n"
);

/// A page.
pub(crate) struct Page<'a> {
    /// The title, which says the result first.
    pub(crate) title: &'a str,
    /// Rules of its own, beside [`STYLE`].
    pub(crate) style: &'a str,
    /// The body, as HTML.
    pub(crate) body: &'a str,
}

impl Page<'_> {
    /// The page as HTML.
    pub(crate) fn html(&self) -> String {
        let Page { style, body, .. } = self;
        let title = escaped(self.title);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n{ICON}\n<style>\n{STYLE}{style}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
        )
    }
}

/// Escapes a text for HTML and its attributes.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// The bytes of a PNG file as an address.
pub(crate) fn png_url(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", STANDARD.encode(png))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_escaped() {
        assert_eq!(
            escaped("scale <1, \"2\">"),
            "scale &lt;1, &quot;2&quot;&gt;"
        );
        let page = Page {
            title: "a < b",
            style: "",
            body: "",
        };
        assert!(page.html().contains("<title>a &lt; b</title>"));
    }
}
