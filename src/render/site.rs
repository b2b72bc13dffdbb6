//! Pages of a site: the list of scenes with its search, documents, and what every page has above its title.

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd, html as markdown};

use super::html::shell;
use crate::figure::escape;

/// What the pages of a site have beyond solutions.
const STYLE: &str = "<style>
nav{max-width:46rem;margin:0 auto;padding:.6rem 0;border-bottom:1px solid #8886}
nav a{margin-right:1.2rem}
a{color:#0b57a4}
pre,code{font:.88em/1.45 ui-monospace,Menlo,Consolas,monospace}
pre{overflow-x:auto;padding:.6rem .8rem;border:1px solid #8886}
main>table{border-collapse:collapse;display:block;overflow-x:auto;font-size:.92em}
th,td{border:1px solid #8886;padding:.2rem .5rem;text-align:left;vertical-align:top}
input[type=search]{width:100%;font:inherit;padding:.4rem .6rem;margin:.4rem 0}
.scenes{list-style:none;padding:0;display:grid;grid-template-columns:repeat(auto-fill,minmax(13rem,1fr));gap:.8rem}
.scenes li{margin:0;border:1px solid #8886;padding:.6rem}
.scenes li[hidden]{display:none}
.scenes svg{width:100%;height:9rem;color:CanvasText}
.scenes small{display:block;opacity:.75}
@media (prefers-color-scheme:dark){a{color:#8cc4ff}}
</style>
";

/// Hides what does not hold every word of the search.
const SEARCH: &str = "const box = document.querySelector('input');
const items = [...document.querySelectorAll('.scenes li')];
const count = document.querySelector('output');
function search() {
  const words = box.value.toLowerCase().split(/\\s+/).filter(Boolean);
  let shown = 0;
  for (const item of items) {
    const text = (item.textContent + ' ' + item.dataset.words).toLowerCase();
    item.hidden = !words.every(word => text.includes(word));
    shown += item.hidden ? 0 : 1;
  }
  for (const list of document.querySelectorAll('section')) {
    list.hidden = ![...list.querySelectorAll('li')].some(item => !item.hidden);
  }
  count.textContent = shown + ' of ' + items.length + ' scenes';
}
// A link may hold a search, such as index.html#rod.
try { box.value = decodeURIComponent(location.hash.slice(1)); } catch { box.value = ''; }
box.addEventListener('input', search);
search();
";

/// A scene in the list.
#[derive(Clone, Debug)]
pub struct Listed {
    /// Path of its page from the list.
    pub page: String,
    /// The folder it stands in.
    pub folder: String,
    /// Its title.
    pub title: String,
    /// Its source.
    pub source: String,
    /// Words it is found by besides.
    pub words: String,
    /// A small picture, as SVG; empty where there is none.
    pub svg: String,
}

/// What stands above the title of a page, `up` leading from it to the list, such as `../`.
pub fn above(up: &str) -> String {
    format!(
        "{STYLE}<nav><a href=\"{up}index.html\">Scenes</a><a href=\"{up}guide.html\">Guide</a><a href=\"{up}grading.html\">How carom grades</a></nav>\n"
    )
}

/// The list of scenes, by folder.
pub fn index(scenes: &[Listed]) -> String {
    let mut body = String::from(
        "<p>Collisions of rigid bodies in the plane: each page is derived, proved and drawn from one scene file.</p>\n\
         <label>Find a scene <input type=\"search\" placeholder=\"such as: rod hinge impulse\"></label> <output></output>\n",
    );
    let mut folders: Vec<&str> = scenes.iter().map(|s| s.folder.as_str()).collect();
    folders.dedup();
    for folder in folders {
        let items = scenes.iter().filter(|s| s.folder == folder).map(|s| {
            format!(
                "<li data-words=\"{}\"><a href=\"{}\">{}{}</a><small>{}</small></li>\n",
                escape(&s.words),
                escape(&s.page),
                s.svg,
                escape(&s.title),
                escape(&s.source)
            )
        });
        body.push_str(&format!(
            "<section><h2>{}</h2>\n<ul class=\"scenes\">\n{}</ul></section>\n",
            escape(folder),
            items.collect::<String>()
        ));
    }
    shell("carom", &above(""), &body, Some(SEARCH))
}

/// A document in Markdown as a page. Links to documents and scenes lead to their pages; to files without one there are none.
pub fn document(title: &str, text: &str, pages: &[(String, String)]) -> String {
    let mut is_dropped = false;
    let linked = Parser::new_ext(text, Options::ENABLE_TABLES).map(|event| match event {
        Event::Start(Tag::Link {
            link_type,
            dest_url,
            title,
            id,
        }) => {
            let page = pages.iter().find(|(file, _)| **file == *dest_url);
            is_dropped = page.is_none() && !dest_url.contains(':') && !dest_url.starts_with('#');
            if is_dropped {
                return Event::Text("".into());
            }
            let dest_url = page.map_or(dest_url, |(_, page)| page.clone().into());
            Event::Start(Tag::Link {
                link_type,
                dest_url,
                title,
                id,
            })
        }
        Event::End(TagEnd::Link) if std::mem::take(&mut is_dropped) => Event::Text("".into()),
        // A document of ours holds no markup; a comment in it is for its authors.
        Event::Html(_) | Event::InlineHtml(_) => Event::Text("".into()),
        other => other,
    });
    let mut body = String::new();
    markdown::push_html(&mut body, linked);
    // The title is the page's own.
    let body = match body.split_once("</h1>\n") {
        Some((before, rest)) if before.starts_with("<h1>") => rest.to_string(),
        _ => body,
    };
    shell(title, &above(""), &body, None)
}

/// The text of a scene file, to be read and taken along.
pub fn source(name: &str, text: &str) -> String {
    format!(
        "<section><h2>The scene file</h2>\n<p><a href=\"{0}\" download>{0}</a></p>\n<pre>{1}</pre></section>\n",
        escape(name),
        escape_lines(text)
    )
}

/// Text with its lines kept.
fn escape_lines(text: &str) -> String {
    text.lines().map(|line| escape(line) + "\n").collect()
}
