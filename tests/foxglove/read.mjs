// Usage: node read.mjs RECORD: what Foxglove's reader makes of a record, as one JSON object.
import { ULog } from "@foxglove/ulog";
import { FileReader } from "@foxglove/ulog/node.js";

const log = new ULog(new FileReader(process.argv[2]));
await log.open();

const seen = { units: {}, topics: {} };
for (const [key, value] of log.header.information) {
  if (key.startsWith("unit.")) seen.units[key] = value;
}
// Of every topic: how many, the last message, and the sum of what a reader that is a byte off
// could not get right.
for await (const message of log.readMessages()) {
  if (message.value === undefined) continue;
  const name = log.subscriptions.get(message.msgId).name;
  const topic = (seen.topics[name] ??= { count: 0 });
  topic.count += 1;
  topic.last = message.value;
  if (name === "imu_sample") {
    topic.sums ??= [0, 0, 0];
    message.value.raw_lsb.forEach((raw, axis) => (topic.sums[axis] += raw));
  }
}
console.log(JSON.stringify(seen, (_, value) => {
  if (typeof value === "bigint") return Number(value);
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
}));
