"""Opens pages in one headless Chromium, one after the other, and collects what a script in each of them finds.

The pages come from a server on this host, so that time runs as for a user; nothing else is reached.
"""

import http.server
import json
import re
import shutil
import subprocess
import tempfile
import threading

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = ("--headless", "--no-sandbox", "--hide-scrollbars", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader-webgl", "--enable-unsafe-swiftshader",
           "--ignore-gpu-blocklist", "--remote-debugging-port=0", "--window-size=1300,850")
# before the scripts of a page: errors and requests are counted
BEFORE = """<script>window.found={errors:[],asked:0};window.onerror=(m,u,l,c)=>{found.errors.push(m+' '+l+':'+c)};
for(const k of['error','warn'])console[k]=(...a)=>found.errors.push(a.join(' '));
window.fetch=()=>{found.asked++};XMLHttpRequest.prototype.open=()=>{found.asked++};</script>"""
AFTER = """<script>window.addEventListener('load',async()=>{try{await(async()=>{%s})()}catch(e){found.errors.push(''+e)}
parent.postMessage(JSON.stringify(found),'*')})</script></body>"""
INDEX = """<!DOCTYPE html><title>pages</title><style>body{margin:0}iframe{border:0;width:1300px;height:850px}</style><script>
const names=%s;let k=-1,frame=null;
function next(){if(frame)frame.remove();if(++k==names.length)return;frame=document.createElement('iframe');frame.src='/page/'+k;document.body.append(frame)}
onmessage=async e=>{await fetch('/found/'+k,{method:'POST',body:e.data});next()};onload=next</script><body></body>"""


def browser_here():
    """A browser's command; None if there is none."""
    return next((name for name in BROWSERS if shutil.which(name)), None)


def watched(text, script):
    """A page with a script that runs when all is loaded; what it finds it puts into `found`."""
    head, first, tail = text.partition("<style>")
    body, _, end = tail.rpartition("</body>")
    return head + BEFORE + first + body + AFTER % script + end


def visit(pages, limit=60):
    """What is found in pages, texts by name; at most `limit` seconds for each."""
    names, found, arrived = list(pages), {}, threading.Event()

    class Handler(http.server.BaseHTTPRequestHandler):
        """Gives the pages and takes what is found."""

        def answer(self, text=""):
            """A page."""
            body = text.encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def do_GET(self):  # noqa: N802
            """The list, or a page."""
            number = re.fullmatch(r"/page/([0-9]+)", self.path)
            self.answer(pages[names[int(number.group(1))]] if number else INDEX % json.dumps(names))

        def do_POST(self):  # noqa: N802
            """What a page found."""
            body = self.rfile.read(int(self.headers["Content-Length"]))
            found[names[int(self.path.rsplit("/", 1)[1])]] = json.loads(body)
            self.answer()
            arrived.set()

        def log_message(self, *_):
            """Nothing."""

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen([browser_here(), *OPTIONS, f"--user-data-dir={profile}", f"http://127.0.0.1:{server.server_port}/"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            while len(found) < len(names):
                arrived.clear()
                assert arrived.wait(limit), f"nothing found in {names[len(found)]} within {limit} s"
        finally:
            browser.kill()
            browser.wait()
            server.shutdown()
    return found
