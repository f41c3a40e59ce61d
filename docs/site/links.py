"""Finds links of a built site that lead nowhere. Links to other sites are not followed."""

import re
from html.parser import HTMLParser
from urllib.parse import unquote


class _Collector(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.anchors = [], set()

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(value for key, value in attributes if key in ("id", "name") and value)
        for key in ("href", "src"):
            if values.get(key) is not None and tag != "link":
                self.links.append(values[key])


def broken_links(site):
    pages = {}
    for path in sorted(site.rglob("*.html")):
        if path.name == "404.html":  # its links count from the root of the server
            continue
        collector = _Collector()
        collector.feed(path.read_text())
        pages[path.resolve()] = collector
    broken = []
    for path, page in pages.items():
        for link in page.links:
            if re.match(r"[a-z]+:", link):
                continue
            name, _, fragment = link.partition("#")
            target = (path.parent / unquote(name)).resolve() if name else path
            if not target.exists():
                broken.append(f"{path.relative_to(site.resolve())}: no such page: {link}")
            elif fragment and target in pages and unquote(fragment) not in pages[target].anchors:
                broken.append(f"{path.relative_to(site.resolve())}: no such place: {link}")
    return broken
