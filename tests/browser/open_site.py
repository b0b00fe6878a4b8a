"""The site of `make docs` opened by headless Chromium from the disk: its search finds, and at 420 and 1280 pixels no page is wider
than the window.

open_site.py SITE: exits with 1 if something is wrong. Without a site it says so and is done.
"""

import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from open_pages import browser_here

# pages one after the other in a frame; a page that is wider than its frame is noted
VIEWER = """<iframe id="f" style="width:{width}px;height:900px;border:0"></iframe><script>const pages={pages},wide=[];let k=-1;
const f=document.getElementById('f');f.onload=()=>{{const d=f.contentDocument;if(k>=0&&d.documentElement.scrollWidth>{width})
wide.push(pages[k]+' '+d.documentElement.scrollWidth);if(++k<pages.length)f.src=pages[k];
else document.documentElement.setAttribute('data-found',JSON.stringify([k,wide]))}};f.src=pages[0];k=0;</script>"""


def dom_of(browser, address):
    """A page as it stands when its scripts are done."""
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files",
               "--virtual-time-budget=600000", "--dump-dom", address]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=True).stdout


def main(site):
    """All pages."""
    if not (site / "index.html").exists():
        print("browser-test: no site; make docs")
        return 0
    browser = browser_here()
    if browser is None:
        return 1
    found = dom_of(browser, f"{(site / 'search.html').as_uri()}?q=preload")
    assert "tables/joint.revolute.html" in found, "the search does not find a column"
    pages = [page.as_uri() for page in sorted(site.rglob("*.html"))]
    for width in (420, 1280):
        with tempfile.TemporaryDirectory() as directory:
            viewer = pathlib.Path(directory, "viewer.html")
            viewer.write_text(VIEWER.format(width=width, pages=json.dumps(pages)), encoding="utf-8")
            count, wide = json.loads(html.unescape(re.search(r'data-found="([^"]*)"', dom_of(browser, viewer.as_uri()))[1]))
        assert count == len(pages) and wide == [], (width, count, wide)
    print(f"browser-test: site: {len(pages)} pages, none wider than the window, search finds")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
