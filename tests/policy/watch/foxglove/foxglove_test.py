"""A journal given to viewers by Foxglove's protocol, received with PyPI's websockets.

usage: foxglove_test.py SERVE_JOURNAL WRITE_KNOWN_JOURNAL
"""

import base64
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

import fastjsonschema
from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.sync.client import ClientConnection, connect

SERVER, WRITER = sys.argv[1:3]
PROTOCOL = "foxglove.websocket.v1"
TOPICS = {"/mission", "/navigation", "/snr", "/setpoint", "/health", "/decision", "/pose", "/position", "/log"}
PATIENCE_S = 20.0


class Served(unittest.TestCase):
    def setUp(self) -> None:
        self.serve()

    def serve(self, *turns: str) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        journal = Path(folder.name) / "journal"
        subprocess.run([WRITER, journal, *turns], check=True)
        self.server = subprocess.Popen([SERVER, journal], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.end)
        self.port = int(self.line())

    def end(self) -> None:
        assert self.server.stdin and self.server.stdout
        self.server.stdin.close()
        self.server.stdout.close()
        self.assertEqual(self.server.wait(PATIENCE_S), 0)

    def line(self) -> str:
        assert self.server.stdout
        return self.server.stdout.readline()

    def publish(self) -> None:
        assert self.server.stdin
        self.server.stdin.write("go\n")
        self.server.stdin.flush()
        self.assertEqual(self.line(), "published\n")

    def connect(self, **options: Any) -> ClientConnection:
        options = {"subprotocols": [PROTOCOL], "max_size": None, "proxy": None, "close_timeout": 1} | options
        viewer = connect(f"ws://127.0.0.1:{self.port}", **options)
        self.addCleanup(viewer.close)
        return viewer

    def told(self, viewer: ClientConnection, operation: str) -> dict[str, Any]:
        """The next JSON message of this kind; what comes before it is passed over."""
        while True:
            message = viewer.recv(PATIENCE_S)
            if isinstance(message, str):
                told: dict[str, Any] = json.loads(message)
                if told["op"] == operation:
                    return told

    def channels(self, viewer: ClientConnection) -> dict[str, dict[str, Any]]:
        return {channel["topic"]: channel for channel in self.told(viewer, "advertise")["channels"]}

    def subscribe(self, viewer: ClientConnection, *numbers: int) -> None:
        wanted = [{"id": 100 + number, "channelId": number} for number in numbers]
        viewer.send(json.dumps({"op": "subscribe", "subscriptions": wanted}))

    def message(self, viewer: ClientConnection) -> tuple[int, int, Any]:
        """Subscription, time in nanoseconds and content of the next message."""
        while True:
            data = viewer.recv(PATIENCE_S)
            if isinstance(data, bytes) and data[0] == 1:
                subscription, time_ns = struct.unpack_from("<IQ", data, 1)
                return subscription, time_ns, json.loads(data[13:])

    def test_says_who_it_is_and_that_a_viewer_can_command_nothing(self) -> None:
        viewer = self.connect()
        about = self.told(viewer, "serverInfo")
        self.assertEqual((about["name"], about["capabilities"]), ("Earshot", ["time"]))
        viewer.send(json.dumps({"op": "advertise", "channels": [{"id": 1, "topic": "/order", "encoding": "json"}]}))
        self.assertIn('refused: "advertise"', self.told(viewer, "status")["message"])

    def test_every_channel_is_received_with_a_schema_that_its_messages_fulfil(self) -> None:
        self.publish()
        viewer = self.connect()
        channels = self.channels(viewer)
        self.assertLessEqual(TOPICS, channels.keys())
        self.subscribe(viewer, *(channel["id"] for channel in channels.values()))
        seen: set[str] = set()
        while len(seen) < len(channels):
            subscription, _, content = self.message(viewer)
            channel = next(one for one in channels.values() if one["id"] == subscription - 100)
            self.assertEqual((channel["encoding"], channel["schemaEncoding"]), ("json", "jsonschema"))
            fastjsonschema.compile(json.loads(channel["schema"]))(content)
            seen.add(channel["topic"])

    def test_who_watches_from_the_beginning_receives_every_record_in_its_order(self) -> None:
        viewer = self.connect()
        self.assertEqual(self.told(viewer, "advertise")["channels"], [])
        self.publish()
        channels: dict[str, int] = {}
        while "/health" not in channels:
            for channel in self.told(viewer, "advertise")["channels"]:
                channels[channel["topic"]] = channel["id"]
        self.subscribe(viewer, channels["/health"])
        turns = [self.message(viewer)[2]["turn"]]
        self.publish()
        while len(turns) < 3:
            turns.append(self.message(viewer)[2]["turn"])
        self.assertEqual(turns[1:], sorted(turns[1:]))

    def test_an_unsubscribed_channel_is_silent(self) -> None:
        self.publish()
        viewer = self.connect()
        channels = self.channels(viewer)
        self.subscribe(viewer, channels["/snr"]["id"])
        self.message(viewer)
        viewer.send(json.dumps({"op": "unsubscribe", "subscriptionIds": [100 + channels["/snr"]["id"]]}))
        self.subscribe(viewer, channels["/health"]["id"])
        self.message(viewer)
        self.publish()
        received = {self.message(viewer)[0] for _ in range(3)}
        self.assertEqual(received, {100 + channels["/health"]["id"]})

    def test_what_is_no_request_is_answered_and_the_connection_stays(self) -> None:
        self.publish()
        viewer = self.connect()
        self.channels(viewer)
        for wrong in (
            "{",
            "[]",
            "null",
            '{"op": 3}',
            '{"op": "subscribe", "subscriptions": [{"id": -1, "channelId": 0}]}',
            '{"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 4000000000}, 7]}',
            '{"op": "unsubscribe", "subscriptionIds": ["one"]}',
        ):
            with self.subTest(wrong=wrong):
                viewer.send(wrong)
                self.assertIn(self.told(viewer, "status")["level"], (1, 2))
        viewer.send(b"\x01\x02")
        self.told(viewer, "status")

    def test_a_request_beyond_64_kib_ends_the_connection(self) -> None:
        viewer = self.connect()
        viewer.send('{"op": "' + "x" * 70_000 + '"}')
        with self.assertRaises(ConnectionClosed):
            while True:
                viewer.recv(PATIENCE_S)

    def test_other_sites_other_names_and_other_protocols_are_refused(self) -> None:
        for wrong in (
            {"origin": "https://example.org"},
            {"origin": "null"},
            {"origin": "http://localhost.example.org"},
            {"subprotocols": ["other"]},
            {"subprotocols": None},
        ):
            with self.subTest(wrong=wrong), self.assertRaises((InvalidHandshake, EOFError, OSError)):
                self.connect(**wrong)
        key = base64.b64encode(os.urandom(16)).decode()
        request = f"GET / HTTP/1.1\r\nHost: example.org:{self.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        request += (
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: {PROTOCOL}\r\n\r\n"
        )
        with socket.create_connection(("127.0.0.1", self.port), PATIENCE_S) as line:
            line.sendall(request.encode())
            self.assertNotIn(b" 101 ", line.recv(4096))
        for right in ("https://app.foxglove.dev", "http://localhost:8080"):
            with self.subTest(right=right):
                self.connect(origin=right)

    def test_a_viewer_that_does_not_read_holds_up_nobody_and_memory_is_bounded(self) -> None:
        self.serve("4000")  # 8 MB
        self.publish()
        stuck = self.connect(max_queue=1)
        numbers = [channel["id"] for channel in self.channels(stuck).values()]
        self.subscribe(stuck, *numbers)
        reader = self.connect()
        self.channels(reader)
        self.subscribe(reader, numbers[0])
        self.message(reader)
        for _ in range(5):
            self.publish()
        status = Path(f"/proc/{self.server.pid}/status").read_text()
        resident_kb = int(next(line.split()[1] for line in status.splitlines() if line.startswith("VmRSS")))
        self.assertLess(resident_kb, 80_000)
        self.message(reader)
        deadline = time.monotonic() + PATIENCE_S
        while "were left out" not in self.told(stuck, "status")["message"]:
            self.assertLess(time.monotonic(), deadline)

    def test_at_most_sixteen_viewers_are_served_and_the_next_when_one_goes(self) -> None:
        viewers = [self.connect() for _ in range(16)]
        for viewer in viewers:
            self.told(viewer, "serverInfo")
        late = self.connect()
        with self.assertRaises(ConnectionClosed):
            late.recv(PATIENCE_S)
        viewers[0].close()
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            try:
                self.told(self.connect(), "serverInfo")
                return
            except (ConnectionClosed, InvalidHandshake, EOFError, OSError):
                time.sleep(0.1)
        self.fail("nobody was let in where one had gone")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
