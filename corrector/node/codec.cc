#include "corrector/node/codec.h"

namespace zro::node {
namespace {

// Every message is laid out once, below, in a Layout(); these two walk it in either direction.
class Packer {
 public:
  template <typename M>
  using Of = const M;  ///< the caller's message, not a copy: a copy of fields just set is slow
  template <typename T>
  void operator()(int start, int length, const T& field) {
    word_ |= (static_cast<std::uint64_t>(field) & Mask(length)) << start;
  }
  Frame Finish(std::uint32_t id, std::uint8_t dlc) const {
    Frame f{id, dlc, {}};
    for (int i = 0; i < dlc; ++i) f.data[i] = static_cast<std::uint8_t>(word_ >> (8 * i));
    return f;
  }
  static constexpr std::uint64_t Mask(int length) { return (std::uint64_t{1} << length) - 1; }

 private:
  std::uint64_t word_ = 0;
};

class Unpacker {
 public:
  template <typename M>
  using Of = M;
  explicit Unpacker(const Frame& f) {
    for (int i = 0; i < f.dlc; ++i) word_ |= static_cast<std::uint64_t>(f.data[i]) << (8 * i);
  }
  template <typename T>
  void operator()(int start, int length, T& field) const {
    field = static_cast<T>((word_ >> start) & Packer::Mask(length));
  }

 private:
  std::uint64_t word_ = 0;
};

template <typename Io>
void Layout(Io& io, typename Io::template Of<NmtMsg>& m) {
  io(0, 8, m.command);
  io(8, 8, m.node_id);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<TimeStampMsg>& m) {
  io(0, 28, m.ms);
  io(32, 16, m.days);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<EmcyMsg>& m) {
  io(0, 16, m.code);
  io(16, 8, m.error_register);
  io(24, 8, m.reason);
  io(32, 2, m.axis);
  io(34, 6, m.bin);
  io(40, 16, m.measured);
  io(56, 8, m.event_seq);
}
template <typename Io>
void ThreeWords(Io& io, typename Io::template Of<std::int16_t> (&words)[3]) {
  for (int i = 0; i < 3; ++i) io(16 * i, 16, words[i]);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<RateMsg>& m) {
  ThreeWords(io, m.rate);
  io(48, 8, m.seq);
  io(56, 1, m.valid);
  io(57, 1, m.clipped);
  io(58, 1, m.still);
  io(59, 1, m.corr_applied);
  io(60, 1, m.learning);
  io(61, 1, m.vibration);
  io(62, 1, m.temp_fresh);
  io(63, 1, m.test_mode);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<RawMsg>& m) {
  ThreeWords(io, m.raw);
  io(48, 8, m.seq);
  io(56, 4, m.range_code);
  io(60, 1, m.overrun);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<AccMsg>& m) {
  ThreeWords(io, m.acc);
  io(48, 8, m.seq);
  io(56, 1, m.clipped);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<TimeMsg>& m) {
  io(0, 32, m.sample_time_us);
  io(32, 16, m.sample_seq);
  io(48, 16, m.temperature);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<CorrMsg>& m) {
  ThreeWords(io, m.corr);
  io(48, 6, m.bin);
  io(54, 4, m.state);
  io(58, 6, m.age_s);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<SdoMsg>& m) {
  io(0, 8, m.cmd);
  io(8, 16, m.index);
  io(24, 8, m.sub);
  io(32, 32, m.data);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<StatusMsg>& m) {
  io(0, 8, m.boot_reason);
  io(8, 16, m.boot_count);
  io(24, 24, m.uptime_s);
  io(48, 4, m.corr_mode);
  io(52, 2, m.nv_state);
  io(54, 1, m.test_mode_active);
  io(55, 1, m.rig_heartbeat_ok);
  io(56, 8, m.rejections);
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<IdentMsg>& m) {
  io(0, 8, m.mux);
  switch (m.mux) {
    case 0:
      io(8, 8, m.fw_major);
      io(16, 8, m.fw_minor);
      io(24, 8, m.fw_patch);
      io(32, 32, m.build_id);
      break;
    case 1:
      io(8, 8, m.hw_rev);
      io(32, 32, m.serial);
      break;
    case 2:
      io(8, 8, m.lut_points);
      io(16, 16, m.lut_generation);
      io(32, 32, m.lut_crc32);
      break;
    case 3:
      io(8, 8, m.proto_major);
      io(16, 8, m.proto_minor);
      io(32, 32, m.config_crc32);
      break;
    default:
      break;
  }
}
template <typename Io>
void Layout(Io& io, typename Io::template Of<HeartbeatMsg>& m) {
  io(0, 8, m.state);
}

template <typename M>
Frame Pack(std::uint32_t id, const M& m) {
  Packer packer;
  Layout(packer, m);
  return packer.Finish(id, M::kDlc);
}

template <typename M>
bool Unpack(const Frame& f, std::uint32_t id, M* out) {
  if (f.id != id || f.dlc != M::kDlc) return false;
  const Unpacker unpacker(f);
  Layout(unpacker, *out);
  return true;
}

}  // namespace

Frame Encode(const NmtMsg& m) { return Pack(m.kId, m); }
Frame Encode(const TimeStampMsg& m) { return Pack(m.kId, m); }
Frame Encode(const EmcyMsg& m) { return Pack(m.kId, m); }
Frame Encode(const RateMsg& m) { return Pack(m.kId, m); }
Frame Encode(const RawMsg& m) { return Pack(m.kId, m); }
Frame Encode(const AccMsg& m) { return Pack(m.kId, m); }
Frame Encode(const TimeMsg& m) { return Pack(m.kId, m); }
Frame Encode(const CorrMsg& m) { return Pack(m.kId, m); }
Frame Encode(const SdoMsg& m) { return Pack(m.id, m); }
Frame Encode(const StatusMsg& m) { return Pack(m.kId, m); }
Frame Encode(const IdentMsg& m) { return Pack(m.kId, m); }
Frame Encode(const HeartbeatMsg& m) { return Pack(m.id, m); }

bool Decode(const Frame& f, NmtMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, TimeStampMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, EmcyMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, RateMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, RawMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, AccMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, TimeMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, CorrMsg* out) { return Unpack(f, out->kId, out); }
bool Decode(const Frame& f, StatusMsg* out) { return Unpack(f, out->kId, out); }

bool Decode(const Frame& f, IdentMsg* out) {
  if (f.dlc != IdentMsg::kDlc || f.data[0] >= IdentMsg::kPages) return false;
  IdentMsg m{};
  if (!Unpack(f, IdentMsg::kId, &m)) return false;
  *out = m;
  return true;
}

bool Decode(const Frame& f, SdoMsg* out) {
  const std::uint32_t id = f.id == SdoMsg::kTxId ? SdoMsg::kTxId : SdoMsg::kRxId;
  if (!Unpack(f, id, out)) return false;
  out->id = id;
  return true;
}

bool Decode(const Frame& f, HeartbeatMsg* out) {
  const std::uint32_t id =
      f.id == HeartbeatMsg::kNodeId ? HeartbeatMsg::kNodeId : HeartbeatMsg::kRigId;
  if (!Unpack(f, id, out)) return false;
  out->id = id;
  return true;
}

std::uint16_t ToWireU16(float value, float lsb) {
  const float x = value / lsb;
  if (!(x > 0.0f)) return 0;
  return x >= 65535.0f ? std::uint16_t{65535} : static_cast<std::uint16_t>(x + 0.5f);
}

}  // namespace zro::node
