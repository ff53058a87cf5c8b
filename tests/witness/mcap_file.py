"""An MCAP reader and writer that share no line with ours.

    mcap_file.py read FILE     one line of JSON for each message, in the order of the log times
    mcap_file.py write FILE    a file with messages out of order, in two encodings, from the epoch on
"""

import json
import sys

from mcap.reader import make_reader
from mcap.writer import Writer


def read(path):
    with open(path, "rb") as file:
        for schema, channel, message in make_reader(file, validate_crcs=True).iter_messages():
            assert schema.encoding == "jsonschema" and json.loads(schema.data)["type"] == "object"
            told = {
                "topic": channel.topic,
                "from": channel.metadata.get("from"),
                "unit": channel.metadata.get("unit"),
                "t": message.log_time / 1e9,
                "data": json.loads(message.data),
            }
            print(json.dumps(told))


def write(path):
    start = 1_700_000_000_000_000_000
    with open(path, "wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema("joint", "jsonschema", b'{"type":"object"}')
        joint = writer.register_channel("/joint", "json", schema)
        image = writer.register_channel("/camera", "cdr", 0)

        def say(channel, at_ms, data):
            at = start + at_ms * 1_000_000
            writer.add_message(channel, log_time=at, publish_time=at, data=data)

        for at_ms in [0, 40, 20]:
            body = {"target": at_ms / 100, "state": {"angle": [at_ms / 1000, 7], "word": 4}}
            say(joint, at_ms, json.dumps(body).encode())
        say(image, 10, b"\x00\x01")
        writer.finish()


if __name__ == "__main__":
    {"read": read, "write": write}[sys.argv[1]](sys.argv[2])
