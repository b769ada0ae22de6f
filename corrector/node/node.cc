#include "corrector/node/node.h"

#include "corrector/node/limit_objects.h"

namespace zro::node {
namespace {

constexpr std::uint32_t kStatusMs = 1000;
constexpr std::uint32_t kIdentMs = 10000;
constexpr std::uint8_t kProtoMajor = 1, kProtoMinor = 0;

std::uint32_t PeriodsIn(std::uint32_t ms, const Config& config) {
  return static_cast<std::uint32_t>(static_cast<float>(ms) * config.sample_hz / 1000.0f + 0.5f);
}

std::int16_t AddSaturating(std::int16_t a, std::int16_t b) {
  const int sum = a + b;
  return static_cast<std::int16_t>(sum > 32767 ? 32767 : sum < -32768 ? -32768 : sum);
}

bool Subtracts(Source source) {
  return source == Source::kInterpolated || source == Source::kExtrapolatedHold ||
         source == Source::kLearning || source == Source::kFrozen;
}

}  // namespace

Node::Node(const Identity& identity, const Config& config, Storage* storage, FrameSink* sink,
           std::uint16_t time_divider)
    : identity_(identity),
      corrector_(config, storage),
      sink_(sink),
      test_modes_(PeriodsIn(kRigHeartbeatMs, config)),
      objects_(ObjectSources{&identity_, &corrector_, &log_, &test_modes_}),
      sdo_(&objects_, sink),
      time_divider_(time_divider == 0 ? std::uint16_t{1} : time_divider),
      period_ns_(static_cast<std::uint32_t>(1e9f / config.sample_hz + 0.5f)) {}

void Node::Boot(BootReason reason, std::uint16_t boot_count) {
  boot_reason_ = reason;
  boot_count_ = boot_count;
  corrector_.Boot();
  SendHeartbeat();
  SendIdentity();
  nmt_state_ = kStateOperational;
  heartbeat_.next_ms = objects_.heartbeat_ms();
  status_.next_ms = kStatusMs;
  ident_.next_ms = kIdentMs;
  DrainEvents();
}

void Node::OnFrame(const Frame& frame) {
  if (reset_requested_) return;
  NmtMsg nmt{};
  TimeStampMsg time{};
  HeartbeatMsg heartbeat{};
  if (Decode(frame, &nmt)) {
    OnNmt(nmt);
  } else if (Decode(frame, &heartbeat) && heartbeat.id == HeartbeatMsg::kRigId) {
    rig_heard_ = true;
    rig_heard_ms_ = now_ms_;
    test_modes_.OnRigHeartbeat();
  } else if (nmt_state_ == kStateStopped) {
    return;
  } else if (Decode(frame, &time)) {
    corrector_.SetDate(time.days);
    DrainEvents();
  } else if (frame.id == SdoMsg::kRxId) {
    sdo_.OnFrame(frame);
    corrector_.SetTestMode(test_modes_.active());
    DrainEvents();
  }
}

void Node::OnNmt(const NmtMsg& message) {
  if (message.node_id != 0 && message.node_id != kNodeId) return;
  switch (message.command) {
    case kNmtStart:
      if (!operational()) until_time_ = 0;
      nmt_state_ = kStateOperational;
      return;
    case kNmtStop:
      nmt_state_ = kStateStopped;
      return;
    case kNmtEnterPreOp:
      nmt_state_ = kStatePreOperational;
      return;
    case kNmtResetNode:
    case kNmtResetComm:
      reset_requested_ = true;
      return;
    default:
      return;
  }
}

void Node::OnSample(const RawSample& raw) {
  if (!operational() || reset_requested_) return;
  const bool time_due = until_time_ == 0;
  until_time_ = static_cast<std::uint16_t>((time_due ? time_divider_ : until_time_) - 1);
  const Sample sample = NextSample(raw, time_due);
  if (time_due) SendTime(raw);
  SendRaw(raw);
  output_ = corrector_.Step(sample);
  SendRate(static_cast<std::uint8_t>(raw.counter), sample, time_due);
  if (time_due) SendCorrection();
  DrainEvents();
}

Sample Node::NextSample(const RawSample& raw, bool time_due) {
  if (time_due) temperature_ = raw.temperature;
  RawSample seen = raw;
  seen.temperature = temperature_;
  const std::uint32_t elapsed = Elapsed(raw.counter, last_counter_, first_sample_);
  test_modes_.OnSample(elapsed);
  corrector_.SetTestMode(test_modes_.active());
  for (int i = 0; i < kAxes; ++i) {
    seen.gyro[i] = AddSaturating(raw.gyro[i], test_modes_.injection_lsb()[i]);
  }
  const Sample sample = ToSample(seen, last_counter_, first_sample_);
  periods_ += first_sample_ ? 0 : elapsed;
  last_counter_ = raw.counter;
  first_sample_ = false;
  return sample;
}

void Node::SendTime(const RawSample& raw) {
  sink_->Send(Encode(TimeMsg{DeviceMicroseconds(periods_), raw.counter, raw.temperature}));
}

void Node::SendRaw(const RawSample& raw) {
  const auto seq = static_cast<std::uint8_t>(raw.counter);
  sink_->Send(
      Encode(RawMsg{{raw.gyro[0], raw.gyro[1], raw.gyro[2]}, seq, raw.range_code, raw.overrun}));
  sink_->Send(Encode(AccMsg{{raw.accel[0], raw.accel[1], raw.accel[2]}, seq, raw.accel_clipped}));
}

void Node::SendRate(std::uint8_t seq, const Sample& sample, bool temp_fresh) {
  RateMsg m{};
  for (int i = 0; i < kAxes; ++i) m.rate[i] = ToWire16(output_.rate_dps[i], kDpsPerRateLsb);
  m.seq = seq;
  m.valid = !sample.gyro_clipped && !sample.overrun;
  m.clipped = sample.gyro_clipped;
  m.still = output_.still;
  m.corr_applied = Subtracts(output_.source);
  m.learning = output_.learning;
  m.vibration = output_.vibration;
  m.temp_fresh = temp_fresh;
  m.test_mode = test_modes_.active();
  sink_->Send(Encode(m));
}

void Node::SendCorrection() {
  CorrMsg m{};
  for (int i = 0; i < kAxes; ++i) m.corr[i] = ToWire16(output_.zro_dps[i], kDpsPerCorrLsb);
  m.bin = output_.bin;
  m.state = static_cast<std::uint8_t>(output_.source);
  m.age_s = output_.age_days == 0 ? 0 : 63;  // six bits of seconds, saturating: today or older
  sink_->Send(Encode(m));
}

void Node::OnTime(std::uint32_t now_ms) {
  if (reset_requested_) return;
  now_ms_ = now_ms;
  const std::uint16_t heartbeat_ms = objects_.heartbeat_ms();
  if (heartbeat_ms != 0 && heartbeat_.Due(now_ms, heartbeat_ms)) SendHeartbeat();
  if (status_.Due(now_ms, kStatusMs) && operational()) SendStatus();
  if (ident_.Due(now_ms, kIdentMs) && operational()) SendIdentity();
}

bool Node::Timer::Due(std::uint32_t now_ms, std::uint32_t period_ms) {
  if (static_cast<std::int32_t>(now_ms - next_ms) < 0) return false;
  next_ms += period_ms;
  if (static_cast<std::int32_t>(now_ms - next_ms) >= 0) next_ms = now_ms + period_ms;  // far behind
  return true;
}

void Node::SendHeartbeat() { sink_->Send(Encode(HeartbeatMsg{HeartbeatMsg::kNodeId, nmt_state_})); }

void Node::SendStatus() {
  StatusMsg m{};
  m.boot_reason = static_cast<std::uint8_t>(boot_reason_);
  m.boot_count = boot_count_;
  m.uptime_s = now_ms_ / 1000;
  m.corr_mode = static_cast<std::uint8_t>(corrector_.limits().mode);
  m.nv_state = nv_state();
  m.test_mode_active = test_modes_.active();
  m.rig_heartbeat_ok = rig_heard_ && now_ms_ - rig_heard_ms_ <= kRigHeartbeatMs;
  m.rejections = static_cast<std::uint8_t>(rejections_);
  sink_->Send(Encode(m));
}

std::uint8_t Node::nv_state() const {
  if (corrector_.store_failing()) return 3;
  return corrector_.dirty() ? 1 : 0;
}

void Node::SendIdentity() {
  TableImage image;
  image.Take(corrector_);
  IdentMsg m{};
  m.fw_major = identity_.fw_major;
  m.fw_minor = identity_.fw_minor;
  m.fw_patch = identity_.fw_patch;
  m.build_id = identity_.build_id;
  m.hw_rev = identity_.hw_rev;
  m.serial = identity_.serial;
  m.lut_points = static_cast<std::uint8_t>(image.entries());
  m.lut_generation = static_cast<std::uint16_t>(image.generation());
  m.lut_crc32 = image.crc32();
  m.proto_major = kProtoMajor;
  m.proto_minor = kProtoMinor;
  m.config_crc32 = LimitsCrc(corrector_.limits());
  for (m.mux = 0; m.mux < IdentMsg::kPages; ++m.mux) sink_->Send(Encode(m));
}

void Node::DrainEvents() {
  Event event{};
  while (corrector_.PopEvent(&event)) {
    log_.Put(event, DeviceMicroseconds(event.sample));
    if (IsRejection(event.code)) SendEmergency(event);
  }
}

void Node::SendEmergency(const Event& event) {
  ++rejections_;
  EmcyMsg m{};
  m.code = static_cast<std::uint16_t>(kEmcyRejection + static_cast<std::uint8_t>(event.code));
  objects_.AddError(m.code, event.seq);
  m.error_register = objects_.error_register();
  m.reason = static_cast<std::uint8_t>(event.code);
  m.axis = event.axis;
  m.bin = event.bin;
  m.measured = event.axis < kAxes ? ToWire16(event.measured_dps[event.axis], kDpsPerRateLsb)
                                  : std::int16_t{0};
  m.event_seq = static_cast<std::uint8_t>(event.seq);
  if (nmt_state_ != kStateStopped) sink_->Send(Encode(m));
}

std::uint32_t Node::DeviceMicroseconds(std::uint32_t sample) const {
  return static_cast<std::uint32_t>(std::uint64_t{sample} * period_ns_ / 1000);
}

}  // namespace zro::node
