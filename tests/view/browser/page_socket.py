"""A page's socket without a page: what a browser would send, from Python's own library alone."""

import base64
import json
import os
import socket
import struct

# Seconds for what must come in the end: a loaded machine may compile kernels first.
PATIENCE = 180


class PageSocket:
    """A WebSocket (RFC 6455), as far as these tests need it."""

    def __init__(self, view, token=None, origin=None, host=None):
        self.connection = socket.create_connection(("127.0.0.1", view.port), timeout=PATIENCE)
        host = host or f"127.0.0.1:{view.port}"
        origin = f"http://{host}" if origin is None else origin
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET /{token or view.token}/live HTTP/1.1", f"Host: {host}", "Upgrade: websocket",
                 "Connection: Upgrade", f"Sec-WebSocket-Key: {key}", "Sec-WebSocket-Version: 13"]
        if origin:
            lines.append(f"Origin: {origin}")
        self.connection.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.kept = b""
        while b"\r\n\r\n" not in self.kept:
            more = self.connection.recv(4096)
            assert more, "the connection was closed"
            self.kept += more
        head, self.kept = self.kept.split(b"\r\n\r\n", 1)
        self.status = int(head.split()[1])

    def send(self, payload, opcode=1):
        if not isinstance(payload, (bytes, str)):
            payload = json.dumps(payload)
        data = payload.encode() if isinstance(payload, str) else payload
        if len(data) < 126:
            head = struct.pack("!BB", 0x80 | opcode, 0x80 | len(data))
        elif len(data) < 65536:
            head = struct.pack("!BBH", 0x80 | opcode, 0x80 | 126, len(data))
        else:
            head = struct.pack("!BBQ", 0x80 | opcode, 0x80 | 127, len(data))
        # The mask 0 leaves the bytes as they are.
        self.connection.sendall(head + b"\0\0\0\0" + data)

    def read(self, count):
        while len(self.kept) < count:
            more = self.connection.recv(65536)
            if not more:
                raise ConnectionError("closed")
            self.kept += more
        data, self.kept = self.kept[:count], self.kept[count:]
        return data

    def receive(self):
        """The next message: a dictionary; of a frame its header, with the file as "file"."""
        first, length = struct.unpack("!BB", self.read(2))
        if length == 126:
            (length,) = struct.unpack("!H", self.read(2))
        elif length == 127:
            (length,) = struct.unpack("!Q", self.read(8))
        data = self.read(length)
        if first & 15 == 8:
            raise ConnectionError("closed")
        if first & 15 == 2:
            (size,) = struct.unpack("<I", data[:4])
            return {"type": "frame", **json.loads(data[4 : 4 + size]), "file": data[4 + size :]}
        return json.loads(data)

    def receive_until(self, is_wanted):
        """Acknowledges all frames. Returns everything up to the wanted message."""
        messages = []
        while not (messages and is_wanted(messages[-1])):
            messages.append(self.receive())
            if messages[-1]["type"] == "frame":
                self.send({"type": "acknowledge", "frame": messages[-1]["frame"]})
        return messages

    def set(self, number, moving=False, **settings):
        named = {key.replace("__", "."): value for key, value in settings.items()}
        self.send({"type": "state", "number": number, "moving": moving, "settings": named,
                   "hidden": []})
