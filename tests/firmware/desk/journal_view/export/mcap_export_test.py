"""An MCAP file of earshot journal, read by Foxglove's own reader (PyPI's mcap).

usage: mcap_export_test.py EARSHOT_JOURNAL WRITE_KNOWN_JOURNAL
"""

import json
import resource
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from collections import Counter
from pathlib import Path
from typing import Any

import zstandard
from mcap.reader import NonSeekingReader, SeekingReader, make_reader
from mcap.records import ChunkIndex, DataEnd, Footer
from mcap.stream_reader import CRCValidationError, StreamReader

PROGRAM, WRITER = sys.argv[1:3]
MESSAGE, CHUNK, MESSAGE_INDEX, ATTACHMENT, DATA_END = 0x05, 0x06, 0x07, 0x09, 0x0F  # opcodes
POLICY = b"\x01\x02\x03"  # kPolicy of known_journal.hpp
TURNS = 8_000  # fill more than two chunks of 1 MiB
BEGAN_NS = 1_795_359_840 * 10**9  # 2026-11-22 15:04:00 UTC


class McapExport(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.journal = Path(folder.name) / "journal"
        self.path = Path(folder.name) / "flight.mcap"
        self.lines = Path(folder.name) / "records.jsonl"

    def write(self, *options: str, turns: int | None = None, tables: str | None = None) -> None:
        beginning = [] if turns is None else [str(turns)]
        subprocess.run([WRITER, self.journal, *beginning, *([] if tables is None else [tables])], check=True)
        command = [PROGRAM, str(self.journal), "--mcap", str(self.path), *options, "--quiet"]
        ended = subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
        self.assertEqual(ended.returncode, 0 if turns is None else 1)  # without a closing record

    def attached(self) -> dict[str, tuple[str, bytes, int]]:
        with self.path.open("rb") as file:
            attachments = list(make_reader(file, validate_crcs=True).iter_attachments())
        return {a.name: (a.media_type, a.data, a.log_time) for a in attachments}

    def read(self) -> list[tuple[str, Any, Any]]:
        with self.path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True)
            self.assertIsInstance(reader, SeekingReader)
            return [
                (channel.topic, message, json.loads(message.data)) for _, channel, message in reader.iter_messages()
            ]

    def on(self, topic: str) -> list[tuple[Any, Any]]:
        return [(message, data) for t, message, data in self.read() if t == topic]

    def test_has_every_record_on_a_topic_of_its_kind(self) -> None:
        self.write("--origin", "38.5,-20.1")
        counts = Counter(topic for topic, _, _ in self.read())
        expected = {"/mission": 1, "/policy": 1, "/health": 4, "/order": 1, "/navigation": 2, "/snr": 1, "/setpoint": 1}
        expected |= {"/vehicle_status": 1, "/decision": 1, "/acknowledgement": 1, "/port_report": 2, "/safety_event": 1}
        self.assertEqual(sum(expected.values()), 17)
        # A fix of two has a place; the timeline has 13 lines.
        self.assertEqual(counts, expected | {"/journal_end": 1, "/pose": 1, "/position": 1, "/log": 13})

    def test_dates_messages_by_the_record_and_by_their_sender(self) -> None:
        self.write()
        ((message, data),) = self.on("/snr")
        self.assertEqual(message.log_time, BEGAN_NS + 1_900_000_000)
        self.assertEqual(message.publish_time, BEGAN_NS + 1_700_000_000)
        self.assertEqual(message.sequence, 5)  # the journal's sixth record
        self.assertEqual(data, {"port": 2, "valid_time_s": 1795359841.7, "snr_db": 12.25, "too_faint": False})

    def test_leaves_out_what_is_not_known(self) -> None:
        self.write()
        ((_, data),) = self.on("/vehicle_status")
        expected = {
            "port": 1,
            "valid_time_s": 1795359841.94,
            "battery_percent": 80.5,
            "leak": False,
            "ground_fault": False,
        }
        self.assertEqual(data, expected)

    def test_shows_the_vehicle_in_space_on_a_map_and_in_the_log(self) -> None:
        self.write("--origin", "38.5,-20.1")
        ((_, pose),) = self.on("/pose")
        self.assertEqual(pose["timestamp"], {"sec": 1795359841, "nsec": 800_000_000})
        self.assertEqual(pose["pose"]["position"], {"x": 2000.0, "y": 1000.0, "z": -299.5})
        ((_, fix),) = self.on("/position")
        # 111010.7 and 87236.7 m a degree at 38.5 N (WGS-84); the plane's own error is millimetres here.
        self.assertAlmostEqual(fix["latitude"], 38.5 + 1000 / 111_010.7, places=6)
        self.assertAlmostEqual(fix["longitude"], -20.1 + 2000 / 87_236.7, places=5)
        self.assertEqual(fix["altitude"], -299.5)
        levels = {data["message"]: data["level"] for _, data in self.on("/log")}
        self.assertEqual(levels["STANDBY"], 2)
        self.assertEqual(levels["rule 11, battery_percent: 14.9, below 15.0: abort"], 4)

    def test_has_no_map_without_an_origin(self) -> None:
        self.write()
        self.assertEqual(self.on("/position"), [])

    def test_says_of_every_field_what_it_is(self) -> None:
        self.write("--origin", "38.5,-20.1")
        kinds = {int: "integer", float: "number", str: "string", bool: "boolean", list: "array", dict: "object"}
        with self.path.open("rb") as file:
            for schema, channel, message in make_reader(file).iter_messages():
                assert schema is not None
                self.assertEqual((schema.encoding, channel.message_encoding), ("jsonschema", "json"))
                properties = json.loads(schema.data)["properties"]
                for name, value in json.loads(message.data).items():
                    if value != []:
                        self.assertEqual(properties[name]["type"], kinds[type(value)], f"{channel.topic} {name}")

    def test_sums_up_in_statistics_what_it_holds(self) -> None:
        self.write(turns=TURNS)
        with self.path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None and summary.statistics is not None
        statistics = summary.statistics
        # Beside the turns: SEARCH, and that the end is missing.
        self.assertEqual(statistics.message_count, TURNS + 2)
        self.assertEqual(
            (statistics.message_start_time, statistics.message_end_time), (BEGAN_NS + 10**6, BEGAN_NS + TURNS * 10**6)
        )
        counts = {summary.channels[i].topic: n for i, n in statistics.channel_message_counts.items()}
        self.assertEqual(counts, {"/health": TURNS, "/log": 2})
        self.assertGreater(statistics.chunk_count, 1)
        self.assertEqual(statistics.chunk_count, len(summary.chunk_indexes))

    def test_finds_a_moment_without_reading_the_rest(self) -> None:
        self.write(turns=TURNS)
        begin, end = BEGAN_NS + 6_000 * 10**6, BEGAN_NS + 6_003 * 10**6
        with self.path.open("rb") as file:
            found = make_reader(file).iter_messages(topics=["/health"], starting_at=begin, ending_before=end)
            self.assertEqual([json.loads(message.data)["turn"] for _, _, message in found], [6_000, 6_001, 6_002])

    def test_holds_the_mission_and_the_policy_as_files(self) -> None:
        self.write("--jsonl", str(self.lines))
        attached = self.attached()
        self.assertEqual(sorted(attached), ["journal.policy", "mission.json"])  # this mission has no tables
        media_type, mission, time = attached["mission.json"]
        self.assertEqual((media_type, time), ("application/json", BEGAN_NS))
        records = [json.loads(line) for line in self.lines.read_text().splitlines()]
        (told,) = (record["fields"] for record in records if record["topic"] == "mission")
        self.assertEqual(json.loads(mission), told)
        self.assertEqual(attached["journal.policy"], ("application/octet-stream", POLICY, BEGAN_NS))

    def test_holds_the_tables_as_a_file_where_there_are_any(self) -> None:
        self.write(turns=3, tables="of an ocean")
        self.assertEqual(self.attached(), {"journal.tables": ("application/octet-stream", b"of an ocean", BEGAN_NS)})
        self.write(turns=3, tables="")
        self.assertEqual(self.attached(), {})

    def test_points_at_every_attachment(self) -> None:
        self.write()
        content = self.path.read_bytes()
        with self.path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None and summary.statistics is not None
        self.assertEqual(summary.statistics.attachment_count, len(summary.attachment_indexes))
        for index in summary.attachment_indexes:
            opcode, length = struct.unpack_from("<BQ", content, index.offset)
            self.assertEqual((opcode, 9 + length), (ATTACHMENT, index.length))
            record = content[index.offset + 9 : index.offset + index.length]
            self.assertEqual(struct.unpack_from("<QQ", record), (index.log_time, index.create_time))
            # Behind the times, name and media type behind their lengths; the data behind theirs, and the checksum.
            start = 16 + 4 + len(index.name) + 4 + len(index.media_type)
            self.assertEqual(struct.unpack_from("<Q", record, start), (index.data_size,))
            self.assertEqual(start + 8 + index.data_size + 4, length)
            self.assertEqual(struct.unpack("<I", record[-4:]), (zlib.crc32(record[:-4]),))

    def test_compresses_its_chunks_with_zstd(self) -> None:
        self.write(turns=TURNS)
        content = self.path.read_bytes()
        with self.path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None
        for index in summary.chunk_indexes:
            self.assertEqual(index.compression, "zstd")
            *_, size, checksum, length = struct.unpack_from("<QQQII", content, index.chunk_start_offset + 9)
            self.assertEqual(
                (size, content[index.chunk_start_offset + 9 + 32 :][:length]), (index.uncompressed_size, b"zstd")
            )
            records = self.records_of(content, index)
            self.assertEqual((len(records), zlib.crc32(records)), (index.uncompressed_size, checksum))
            self.assertLess(
                10 * index.compressed_size, index.uncompressed_size
            )  # lines of JSON that are nearly the same

    @staticmethod
    def records_of(content: bytes, index: ChunkIndex) -> bytes:
        """Of a chunk: behind its two times, size, checksum and compression."""
        start = index.chunk_start_offset + 9 + 16 + 8 + 4 + 4 + len("zstd") + 8
        return zstandard.ZstdDecompressor().decompress(content[start : start + index.compressed_size])

    def test_leaves_nothing_when_the_disk_is_full(self) -> None:
        subprocess.run([WRITER, self.journal, str(TURNS)], check=True)

        def on_a_small_disk() -> None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))  # bytes; the file takes more

        command = [PROGRAM, str(self.journal), "--mcap", str(self.path), "--quiet"]
        ended = subprocess.run(
            command, check=False, capture_output=True, text=True, preexec_fn=on_a_small_disk, restore_signals=False
        )
        self.assertEqual(ended.returncode, 2)
        self.assertIn("flight.mcap: cannot be written", ended.stderr)
        self.assertEqual([path.name for path in self.path.parent.iterdir()], ["journal"])

    def test_points_at_every_chunk_index_and_message(self) -> None:
        self.write(turns=TURNS)
        content = self.path.read_bytes()
        with self.path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None
        position, pointed_at = summary.chunk_indexes[0].chunk_start_offset, 0
        for index in summary.chunk_indexes:  # they stand one behind the other
            self.assertEqual((index.chunk_start_offset, content[position]), (position, CHUNK))
            records = self.records_of(content, index)
            position += index.chunk_length
            end = position + index.message_index_length
            for channel, offset in index.message_index_offsets.items():
                opcode, _, of_channel, size = struct.unpack_from("<BQHI", content, offset)
                self.assertEqual((opcode, of_channel), (MESSAGE_INDEX, channel))
                for log_time, at in struct.iter_unpack("<QQ", content[offset + 15 : offset + 15 + size]):
                    opcode, _, *message = struct.unpack_from("<BQHIQ", records, at)
                    self.assertEqual((opcode, message[0], message[2]), (MESSAGE, channel, log_time))
                    pointed_at += 1
            position = end
        self.assertEqual(content[position], DATA_END)
        self.assertEqual(pointed_at, TURNS + 2)

    def test_points_at_the_parts_of_its_summary(self) -> None:
        self.write()
        content = self.path.read_bytes()
        _, offsets_start, _ = struct.unpack("<QQI", content[-28:-8])
        group_starts = {}
        for _, size, opcode, start, length in struct.iter_unpack("<BQBQQ", content[offsets_start:-37]):
            self.assertEqual((size, content[start]), (17, opcode))
            group_starts[start] = start + length
        # Schemas, channels, statistics, chunk indexes, attachment indexes: one behind the other.
        self.assertEqual(len(group_starts), 5)
        self.assertEqual(sorted(group_starts)[1:] + [offsets_start], sorted(group_starts.values()))

    def test_reads_the_same_from_beginning_to_end_without_an_index(self) -> None:
        self.write(turns=TURNS)
        with self.path.open("rb") as file:
            turns = [m.sequence for _, c, m in NonSeekingReader(file).iter_messages() if c.topic == "/health"]
        self.assertEqual(turns, list(range(TURNS)))

    def test_has_checksums_of_its_data_and_of_its_summary(self) -> None:
        self.write()
        content = self.path.read_bytes()
        with self.path.open("rb") as file:
            records = list(StreamReader(file, emit_chunks=True).records)
        (data_end,) = (record for record in records if isinstance(record, DataEnd))
        (footer,) = (record for record in records if isinstance(record, Footer))
        # Behind the data: DataEnd of 1 + 8 + 4 bytes; at the end: the checksum's 4 bytes and the magic's 8.
        self.assertEqual(data_end.data_section_crc, zlib.crc32(content[: footer.summary_start - 13]))
        self.assertEqual(footer.summary_crc, zlib.crc32(content[footer.summary_start : -12]))

    def test_shows_by_its_checksums_that_a_byte_was_flipped(self) -> None:
        self.write()
        whole = self.path.read_bytes()
        with self.path.open("rb") as file:
            summary = make_reader(file).get_summary()
        assert summary is not None
        (chunk,) = summary.chunk_indexes
        # The middle of the compressed records: they no longer unpack, or to others.
        self.flip(whole, chunk.chunk_start_offset + chunk.chunk_length - chunk.compressed_size // 2)
        with self.assertRaises((CRCValidationError, zstandard.ZstdError)):
            self.read()
        policy = summary.attachment_indexes[-1]
        self.flip(whole, policy.offset + policy.length - 5)  # before its checksum
        with self.path.open("rb") as file, self.assertRaises(CRCValidationError):
            list(NonSeekingReader(file, validate_crcs=True).iter_attachments())
        self.path.write_bytes(whole)
        self.assertEqual(len(self.read()), 32)
        self.assertEqual(len(self.attached()), 2)

    def flip(self, whole: bytes, at: int) -> None:
        self.path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x01]) + whole[at + 1 :])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
