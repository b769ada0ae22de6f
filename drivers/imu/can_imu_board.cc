#include "drivers/imu/can_imu_board.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corrector/bytes.h"
#include "corrector/crc32.h"
#include "corrector/node/byte_writer.h"
#include "corrector/node/codec.h"
#include "corrector/node/event_log.h"
#include "corrector/node/node.h"
#include "corrector/node/object_dictionary.h"
#include "corrector/node/test_modes.h"

namespace zrobench {
namespace {

using zro::node::ByteWriter;
using zro::node::Frame;

constexpr Duration kAliveFor = std::chrono::milliseconds(1500);
constexpr std::uint32_t kNodeIdMask = 0x7F;  // CiA 301, 7.3.3: predefined connection set
constexpr std::int64_t kMsPerDay = 86'400'000;
constexpr std::int64_t kDaysTo1984 = 5113;  // from 1970-01-01: 14 years, three of them leap years

std::string Moved() { return "board table: its generation changes faster than it can be read"; }

}  // namespace

CanImuBoard::CanImuBoard(CanBus& bus, Clock& clock, FrameListener* listener)
    : bus_(bus), clock_(clock), listener_(listener), sdo_(bus, clock, [this] { return Pump(); }) {}

Status CanImuBoard::Pump() {
  while (const std::optional<CanFrame> frame = bus_.Receive()) {
    if (Status forwards = WatchTime(frame->at); !forwards) return forwards;
    if (listener_ != nullptr) listener_->OnFrame(*frame);
    if (frame->own) continue;
    if ((frame->frame.id & kNodeIdMask) == zro::node::Node::kNodeId) {
      heard_ = true;
      last_heard_ = frame->at;
    }
    Take(frame->frame);
  }
  if (bus_.health().bus_off) {
    return Fail(Error::Kind::kClosed, "CAN: bus off (wiring, termination, bit rate?)");
  }
  return {};
}

Status CanImuBoard::WatchTime(Instant at) {
  if (at < last_frame_) {
    return Fail(Error::Kind::kTime,
                fmt::format("CAN: time goes backwards: a frame of {:.6f} s after one of {:.6f} s "
                            "(the adapter's clock?)",
                            SecondsOf(at), SecondsOf(last_frame_)));
  }
  last_frame_ = at;
  return {};
}

void CanImuBoard::Take(const Frame& frame) {
  zro::node::RawMsg raw{};
  zro::node::HeartbeatMsg heartbeat{};
  zro::node::StatusMsg status{};
  if (Decode(frame, &raw)) {
    CountSample(raw.seq);
  } else if (frame.id == zro::node::SdoMsg::kTxId) {
    sdo_.OnFrame(frame);
  } else if (frame.id == zro::node::EmcyMsg::kId) {
    ++status_.emcy;
  } else if (Decode(frame, &status)) {
    status_.boot_count = status.boot_count;
  } else if (Decode(frame, &heartbeat) && heartbeat.id == heartbeat.kNodeId &&
             heartbeat.state == zro::node::kStateBootUp) {
    ++status_.boots_seen;
    have_seq_ = false;  // counts start anew: no gap
  }
}

void CanImuBoard::CountSample(std::uint8_t seq) {
  ++status_.samples;
  if (have_seq_) status_.sequence_gaps += static_cast<std::uint8_t>(seq - last_seq_ - 1);
  have_seq_ = true;
  last_seq_ = seq;
}

BoardStatus CanImuBoard::status() const {
  BoardStatus status = status_;
  status.alive = heard_ && clock_.now() - last_heard_ <= kAliveFor;
  return status;
}

Status CanImuBoard::Reset() {
  return bus_.Send(Encode(zro::node::NmtMsg{zro::node::kNmtResetNode, zro::node::Node::kNodeId}));
}

Status CanImuBoard::SendDate(UtcNs utc) {
  const std::int64_t ms = utc / 1'000'000;
  const std::int64_t days = ms / kMsPerDay - kDaysTo1984;
  if (ms < 0 || days < 0 || days > 0xFFFF) {
    return Fail(
        Error::Kind::kConfig,
        fmt::format("date: {} s since 1970 does not fit CiA 301 TIME (1984 to 2163)", ms / 1000));
  }
  return bus_.Send(Encode(zro::node::TimeStampMsg{static_cast<std::uint32_t>(ms % kMsPerDay),
                                                  static_cast<std::uint16_t>(days)}));
}

Status CanImuBoard::SendHeartbeat() {
  return bus_.Send(Encode(
      zro::node::HeartbeatMsg{zro::node::HeartbeatMsg::kRigId, zro::node::kStateOperational}));
}

Status CanImuBoard::WriteU32(std::uint16_t index, std::uint8_t sub, std::uint32_t value,
                             Instant deadline) {
  std::uint8_t bytes[4];
  zro::PutU32(value, bytes);
  return sdo_.Download(index, sub, bytes, deadline);
}

Result<std::uint32_t> CanImuBoard::ReadU32(std::uint16_t index, std::uint8_t sub,
                                           Instant deadline) {
  const Result<std::vector<std::uint8_t>> bytes = sdo_.Upload(index, sub, deadline);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->size() != 4) {
    return Fail(Error::Kind::kProtocol,
                fmt::format("object 0x{:04X}:{} has {} bytes, not 4", index, sub, bytes->size()));
  }
  return zro::GetU32(bytes->data());
}

Result<CanImuBoard::TableHeader> CanImuBoard::ReadTableHeader(Instant deadline) {
  const Result<std::uint32_t> generation = ReadU32(0x2000, 7, deadline);
  if (!generation) return tl::unexpected(generation.error());
  const Result<std::uint32_t> crc32 = ReadU32(0x2000, 8, deadline);
  if (!crc32) return tl::unexpected(crc32.error());
  return TableHeader{*generation, *crc32};
}

Result<TableSnapshot> CanImuBoard::ReadTable(Instant deadline) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    Result<std::optional<TableSnapshot>> snapshot = TryReadTable(deadline);
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (*snapshot) return std::move(**snapshot);
  }
  return Fail(Error::Kind::kProtocol, Moved());
}

Result<std::optional<TableSnapshot>> CanImuBoard::TryReadTable(Instant deadline) {
  const std::uint8_t freeze[] = {1}, release[] = {0};
  if (Status frozen = sdo_.Download(0x2004, 1, freeze, deadline); !frozen) {
    return tl::unexpected(frozen.error());
  }
  Result<std::optional<TableSnapshot>> snapshot = ReadFrozenTable(deadline);
  const Status released = sdo_.Download(0x2004, 1, release, deadline);
  if (snapshot && !released) return tl::unexpected(released.error());
  return snapshot;
}

Result<std::optional<TableSnapshot>> CanImuBoard::ReadFrozenTable(Instant deadline) {
  const Result<TableHeader> before = ReadTableHeader(deadline);
  if (!before) return tl::unexpected(before.error());
  Result<std::vector<std::uint8_t>> image = sdo_.Upload(0x2001, 0, deadline);
  if (!image) return tl::unexpected(image.error());
  const Result<TableHeader> after = ReadTableHeader(deadline);
  if (!after) return tl::unexpected(after.error());
  if (*before != *after) return std::optional<TableSnapshot>();
  TableSnapshot snapshot;
  snapshot.image = std::move(*image);
  snapshot.crc32 = before->crc32;
  const std::uint32_t computed = zro::Crc32(snapshot.image.data(), snapshot.image.size());
  if (computed != snapshot.crc32) {
    return Fail(Error::Kind::kProtocol, fmt::format("board table: CRC-32 {:08X}, board says {:08X}",
                                                    computed, snapshot.crc32));
  }
  const bool parsed =
      snapshot.table.FromImage(snapshot.image.data(), snapshot.image.size(), &snapshot.generation);
  if (!parsed || snapshot.generation != before->generation) {
    return Fail(Error::Kind::kProtocol, "board table: not a canonical image of layout 1");
  }
  return std::optional<TableSnapshot>(std::move(snapshot));
}

Result<std::vector<std::array<std::uint8_t, 24>>> CanImuBoard::ReadNewLogRecords(Instant deadline) {
  std::vector<std::array<std::uint8_t, 24>> records;
  while (true) {  // at most 16 come in one transfer
    const Result<std::vector<std::uint8_t>> bytes = sdo_.Upload(0x2201, 0, deadline);
    // The cursor has moved past what came already: that is handed out, the fault shows next time.
    if (!bytes && !records.empty()) return records;
    if (!bytes) return tl::unexpected(bytes.error());
    if (bytes->size() % 24 != 0) {
      return Fail(Error::Kind::kProtocol,
                  fmt::format("board log: {} bytes are not whole records", bytes->size()));
    }
    for (auto from = bytes->begin(); from != bytes->end(); from += 24) {
      std::copy_n(from, 24, records.emplace_back().begin());
    }
    if (bytes->size() < zro::node::EventLog::kMaxRead * 24) return records;
  }
}

Status CanImuBoard::StoreTable(Instant deadline) {
  return WriteU32(0x1010, 1, zro::node::kSaveSignature, deadline);
}

Status CanImuBoard::RestoreFactory(Instant deadline) {
  return WriteU32(0x1011, 1, zro::node::kLoadSignature, deadline);
}

Status CanImuBoard::DownloadFactoryEntry(double temp_degc, const std::array<double, 3>& zro_dps,
                                         double sigma_dps, Instant deadline) {
  std::uint8_t entry[zro::node::kFactoryEntryBytes];
  ByteWriter out(entry, sizeof entry);
  out.PutFloat(static_cast<float>(temp_degc));
  for (double dps : zro_dps) out.PutFloat(static_cast<float>(dps));
  out.PutFloat(static_cast<float>(sigma_dps));
  if (Status unlocked = WriteU32(0x2101, 1, zro::node::TestModes::kKey, deadline); !unlocked) {
    return unlocked;
  }
  const Status downloaded = sdo_.Download(0x2005, 0, entry, deadline);
  const Status locked = WriteU32(0x2101, 1, 0, deadline);
  return downloaded ? locked : downloaded;
}

Status CanImuBoard::SetLoad(double duty_pct, Instant deadline) {
  const std::uint8_t pct[] = {static_cast<std::uint8_t>(std::lround(duty_pct))};
  if (Status unlocked = WriteU32(0x2101, 1, zro::node::TestModes::kKey, deadline); !unlocked) {
    return unlocked;
  }
  const Status set = sdo_.Download(0x2101, 6, pct, deadline);
  if (set && pct[0] != 0) return {};
  const Status locked = WriteU32(0x2101, 1, 0, deadline);
  return set ? locked : set;
}

}  // namespace zrobench
