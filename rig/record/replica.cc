#include "rig/record/replica.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "rig/record/item_reader.h"

namespace zrobench {
namespace {

using zro::node::Frame;

constexpr std::uint8_t kSdoAbort = 0x80;
constexpr std::uint16_t kFirstObject = 0x2000;  ///< of the corrector's own

Frame FrameOf(const BusFrame& item) {
  Frame frame{item.id, item.dlc, {}};
  std::copy(item.data.begin(), item.data.end(), frame.data);
  return frame;
}

bool Same(const Frame& a, const Frame& b) {
  const bool same = std::memcmp(a.data, b.data, sizeof a.data) == 0;  // in line: the usual case
  return a.id == b.id && a.dlc == b.dlc && (same || std::memcmp(a.data, b.data, a.dlc) == 0);
}

/// The frames whose parts an ImuSample and an ImuCorrection hold.
Frame RateFrame(const ImuSample& item) {
  Frame frame{zro::node::RateMsg::kId, zro::node::RateMsg::kDlc, {}};
  std::memcpy(frame.data, item.rate.data(), sizeof item.rate);
  frame.data[6] = item.seq;
  frame.data[7] = item.rate_flags;
  return frame;
}
Frame CorrectionFrame(const ImuCorrection& item) {
  return zro::node::Encode(
      zro::node::CorrMsg{{item.zro[0], item.zro[1], item.zro[2]}, item.bin, item.state, item.age});
}

void Compare(Lockstep& lockstep, bool same, std::uint64_t at_us, std::uint32_t id) {
  ++(same ? lockstep.equal : lockstep.different);
  if (same || lockstep.first_difference_us) return;
  lockstep.first_difference_us = at_us;
  lockstep.first_difference_id = id;
}

bool PopSame(std::deque<Frame>& sent, const Frame& frame) {
  if (sent.empty()) return false;
  const bool same = Same(sent.front(), frame);
  sent.pop_front();
  return same;
}

}  // namespace

Result<std::unique_ptr<Replica>> Replica::Create(const zro::Config& config,
                                                 std::uint16_t time_divider,
                                                 std::span<const std::uint8_t> start_image) {
  std::unique_ptr<Replica> replica(new Replica(config, time_divider));
  if (!replica->storage_.Load(start_image)) {
    return Fail(Error::Kind::kConfig, "the table at the start of the record is no canonical image");
  }
  return replica;
}

void Replica::Send(const Frame& frame) {
  switch (frame.id) {
    case zro::node::RateMsg::kId:
      rate_ = frame;
      break;
    case zro::node::CorrMsg::kId:
      correction_ = frame;
      break;
    case zro::node::EmcyMsg::kId:
      sent_emergencies_.push_back(frame);
      break;
    case zro::node::SdoMsg::kTxId:
      sent_replies_.push_back(frame);
      break;
    default:
      break;
  }
}

void Replica::Reboot() {
  ++boots_;
  counter_ = {};
  logged_ = 0;
  request_.reset();
  // A frame that the old life sent and the bus never carried is no difference.
  sent_emergencies_.clear();
  sent_replies_.clear();
  zro::node::FrameSink* const sink = this;
  node_.emplace(zro::node::Identity{}, config_, &storage_, sink, time_divider_);
  node_->Boot(zro::node::BootReason::kUnknown, static_cast<std::uint16_t>(boots_));
  CollectLog();
}

void Replica::On(const ImuSample& item) {
  const std::uint16_t counter = counter_.Take(item);
  lost_inputs_ += counter_.missing();
  if (!node_) {
    ++lost_inputs_;
    return;
  }
  node_->OnSample(ToRaw(item, counter, temperature_));
  Compare(rates_, Same(rate_, RateFrame(item)), item.at_us, rate_.id);
  CollectLog();
}

void Replica::On(const ImuCorrection& item) {
  if (!node_) return;
  Compare(corrections_, Same(correction_, CorrectionFrame(item)), item.at_us, correction_.id);
}

void Replica::On(const BusFrame& item) {
  const Frame frame = FrameOf(item);
  if (item.own) {
    if (node_) OnOwn(item, frame);
  } else if (item.id == zro::node::HeartbeatMsg::kNodeId &&
             item.data[0] == zro::node::kStateBootUp) {
    Reboot();
  } else if (node_ && item.id == zro::node::SdoMsg::kTxId) {
    OnReply(item, frame);
  } else if (node_ && item.id == zro::node::EmcyMsg::kId) {
    OnEmergency(item, frame);
  }
}

void Replica::OnOwn(const BusFrame& item, const Frame& frame) {
  if (item.id != zro::node::SdoMsg::kRxId) {
    node_->OnFrame(frame);
  } else if (item.data[0] == kSdoAbort) {
    request_.reset();  // the client gave up: no reply will come
    node_->OnFrame(frame);
  } else {
    if (request_) ++lost_inputs_;
    request_ = frame;
    const int command = frame.data[0] >> 5;  // CiA 301, 7.2.4.3: 1 and 2 begin a transfer
    if (command == 1 || command == 2)
      object_ = static_cast<std::uint16_t>(frame.data[1] | frame.data[2] << 8);
  }
}

void Replica::OnReply(const BusFrame& item, const Frame& frame) {
  if (!request_) return;  // late, to a request that was given up
  sent_replies_.clear();
  node_->OnFrame(*request_);
  request_.reset();
  // Below lies what another build or serial number may answer differently.
  if (object_ >= kFirstObject)
    Compare(replies_, PopSame(sent_replies_, frame), item.at_us, item.id);
  CollectLog();
}

void Replica::OnEmergency(const BusFrame& item, const Frame& frame) {
  Compare(emergencies_, PopSame(sent_emergencies_, frame), item.at_us, item.id);
}

void Replica::CollectLog() {
  const std::uint32_t total = node_->log().total();
  if (total == logged_) return;
  if (total < logged_) logged_ = 0;  // cleared
  zro::node::EventLog log = node_->log();
  log.SetCursor(0);
  const std::uint32_t kept = std::min(total, zro::node::EventLog::kCapacity);
  std::uint32_t old = kept - std::min(kept, total - logged_);
  std::uint8_t bytes[zro::node::EventLog::kMaxRead * zro::node::kLogRecordBytes];
  while (const std::uint32_t n = log.Peek(bytes)) {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (old > 0) {
        --old;
        continue;
      }
      auto& record = log_.emplace_back();
      std::memcpy(record.data(), bytes + i * record.size(), record.size());
    }
    log.Advance(n);
  }
  logged_ = total;
}

std::vector<std::uint8_t> Replica::TableImage() const {
  std::vector<std::uint8_t> image;
  if (!node_) return image;
  image.resize(zro::Table::kMaxImageBytes);
  const zro::Corrector& corrector = node_->corrector();
  image.resize(corrector.table().ToImage(corrector.generation(), image.data()));
  return image;
}

Result<std::vector<std::uint8_t>> StartImage(const std::filesystem::path& record) {
  std::optional<std::vector<std::uint8_t>> image;
  auto reader = ItemReader::Open(record);
  if (!reader) return tl::unexpected(reader.error());
  const auto take = [&]<typename T>(const T& item) {
    if constexpr (std::is_same_v<T, TableItem>) image = item.image;
  };
  reader->DrainUntil(take, [&] { return image.has_value(); });
  if (!image) {
    return Fail(Error::Kind::kConfig, record.string() + ": holds no table of the board");
  }
  return *image;
}

}  // namespace zrobench
