"""A server of one folder, with or without ranges, for the tests of the npm package."""

import os
import queue
import re
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer


class FolderServer:
    """Serves `folder` at `address` while it is used as a context. `bytes_sent` counts bodies of ranges; `posted` is
    a queue of what pages send."""

    def __init__(self, folder, ranges=True):
        self.bytes_sent = 0
        self.requests = []
        self.posted = queue.Queue()
        owner = self

        class Handler(SimpleHTTPRequestHandler):
            def __init__(self, *arguments):
                super().__init__(*arguments, directory=str(folder))

            def do_GET(self):
                path = self.translate_path(self.path)
                asked = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
                owner.requests.append((self.path, self.headers.get("Range")))
                if not ranges or not asked or not os.path.exists(path):
                    super().do_GET()
                    return
                size = os.path.getsize(path)
                first, last = int(asked[1]), min(int(asked[2]), size - 1)
                if first >= size:
                    self.send_error(416)
                    return
                with open(path, "rb") as file:
                    file.seek(first)
                    data = file.read(last - first + 1)
                self.send_response(206)
                self.send_header("Content-Range", f"bytes {first}-{last}/{size}")
                self.send_header("Content-Length", str(last - first + 1))
                self.end_headers()
                self.wfile.write(data)
                owner.bytes_sent += last - first + 1

            def do_POST(self):
                owner.posted.put(self.rfile.read(int(self.headers["Content-Length"])))
                self.send_response(204)
                self.end_headers()

            def log_message(self, *_):
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()
