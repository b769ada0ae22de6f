#include "rig/run/steps.h"

#include <fmt/format.h>

#include <cmath>

#include "rig/run/settle.h"

namespace zrobench {
namespace {

constexpr double kRampBand_degc = 0.5;  ///< a ramp is over when the plate is this close
constexpr double kRampTimeout_s = 600;  ///< beyond the ramp's own time
constexpr double kBootTimeout_s = 10;
constexpr double kDay_s = 86400;
constexpr double kDateSettle_s = 1;  ///< the board has the date before anything else happens
constexpr double kBootPoll_s = 0.1;
constexpr std::uint8_t kTableBeforeCut = 1, kTableAfterBoot = 2;  ///< TableItem::when

struct Describer {
  std::string operator()(const Soak& s) const {
    return fmt::format("soak at {:g} degC for {:g} s", s.to_degc, s.hold_s);
  }
  std::string operator()(const Ramp& r) const {
    return fmt::format("ramp to {:g} degC at {:g} degC/min", r.to_degc, r.rate_degc_per_min);
  }
  std::string operator()(const Hold& h) const { return fmt::format("hold for {:g} s", h.for_s); }
  std::string operator()(const Tone& t) const {
    return fmt::format("tone {:g} Hz {:.0f} dB SPL for {:g} s", t.hz, t.spl_db, t.for_s);
  }
  std::string operator()(const Music& m) const {
    return fmt::format("music {:g} to {:g} Hz {:.0f} dB SPL for {:g} s", m.low_hz, m.high_hz,
                       m.spl_db, m.for_s);
  }
  std::string operator()(const Sweep& s) const {
    return fmt::format("sweep {:g} to {:g} Hz {:.0f} dB SPL, {:g} tones for {:g} s", s.from_hz,
                       s.to_hz, s.spl_db, s.tones(), s.for_s);
  }
  std::string operator()(const Load& l) const {
    return fmt::format("load {:g} % for {:g} s", l.duty_pct, l.for_s);
  }
  std::string operator()(const Move& m) const {
    return fmt::format("move {} for {:g} s", m.how, m.for_s);
  }
  std::string operator()(const PowerCycle& p) const {
    return fmt::format("power off for {:g} s", p.off_s);
  }
  std::string operator()(const DateStep& d) const {
    return fmt::format("date {:g} days on", d.advance_days);
  }
};

/// A stimulus as a step of its own, beside those that the step lists: played at once.
Flow PlayAlone(BenchLoop& loop, const Stimulus& stimulus) {
  loop.stimuli().Add(stimulus);
  do {
    if (auto flow = loop.Tick(); !flow) return flow;
  } while (loop.stimuli().playing());
  return {};
}

Flow WaitForBoot(BenchLoop& loop, std::uint32_t boots_before) {
  const Instant give_up = loop.now() + FromSeconds(kBootTimeout_s);
  while (loop.bench().board.status().boots_seen == boots_before) {
    if (loop.now() > give_up) {
      return Stop(Halt::Why::kRigFault, "the board did not boot after power came back");
    }
    if (auto flow = loop.RunFor(kBootPoll_s); !flow) return flow;
  }
  return {};
}

}  // namespace

std::string DescribeStep(const Action& action) { return std::visit(Describer{}, action); }

Flow RunStep(BenchLoop& loop, const Soak& soak) {
  if (auto flow = loop.SetTarget(soak.to_degc); !flow) return flow;
  SettleDetector settle({.band_degc = soak.settled_degc}, soak.to_degc, loop.now());
  while (!settle.settled()) {
    if (settle.timed_out(loop.now())) {
      return Stop(Halt::Why::kRigFault,
                  fmt::format("not settled at {:g} degC within the time limit: plate reads {:.1f} "
                              "degC at {:.0f} % drive",
                              soak.to_degc, loop.plate().process_degc, loop.plate().drive_pct));
    }
    if (auto flow = loop.RunFor(1); !flow) return flow;
    settle.Add(loop.now(), loop.plate().process_degc, loop.board_degc());
  }
  loop.log().WriteEvent({.kind = EventItem::Kind::kSettled, .a = soak.to_degc});
  return loop.RunFor(soak.hold_s);
}

Flow RunStep(BenchLoop& loop, const Ramp& ramp) {
  const double span = std::abs(ramp.to_degc - loop.plate().process_degc);
  const Instant give_up =
      loop.now() + FromSeconds(span / ramp.rate_degc_per_min * 60 + kRampTimeout_s);
  if (auto flow = loop.StartRamp(ramp.to_degc, ramp.rate_degc_per_min); !flow) return flow;
  while (loop.ramping() || std::abs(loop.plate().process_degc - ramp.to_degc) > kRampBand_degc) {
    if (loop.now() > give_up) {
      return Stop(Halt::Why::kRigFault,
                  fmt::format("the plate does not follow the ramp to {:g} degC: it reads {:.1f}",
                              ramp.to_degc, loop.plate().process_degc));
    }
    if (auto flow = loop.Tick(); !flow) return flow;
  }
  return {};
}

Flow RunStep(BenchLoop& loop, const Hold& hold) { return loop.RunFor(hold.for_s); }

Flow RunStep(BenchLoop& loop, const Tone& tone) {
  return PlayAlone(loop, {tone, std::nullopt, std::nullopt});
}

Flow RunStep(BenchLoop& loop, const Move& move) {
  return PlayAlone(loop, {move, std::nullopt, std::nullopt});
}

Flow RunStep(BenchLoop& loop, const Music& music) {
  return PlayAlone(loop, {music, std::nullopt, std::nullopt});
}

Flow RunStep(BenchLoop& loop, const Sweep& sweep) {
  return PlayAlone(loop, {sweep, std::nullopt, std::nullopt});
}

Flow RunStep(BenchLoop& loop, const Load& load) {
  return PlayAlone(loop, {load, std::nullopt, std::nullopt});
}

Flow RunStep(BenchLoop& loop, const PowerCycle& cycle) {
  if (!loop.bench().power) {
    loop.log().Note("power cycle skipped: the station has no power role");
    return {};
  }
  // In this order: every entry of that table has its decision on record. The log lives in RAM.
  if (auto flow = loop.ReadTable(kTableBeforeCut); !flow) return flow;
  if (auto flow = loop.ReadDecisions(); !flow) return flow;
  const std::uint32_t boots = loop.bench().board.status().boots_seen;
  const auto deadline = [&] { return loop.now() + std::chrono::seconds(2); };
  if (const Status off = loop.bench().power->SetOn(false, deadline()); !off) {
    return Stop(Halt::Why::kRigFault, off.error().message);
  }
  loop.log().WriteEvent({.kind = EventItem::Kind::kPower, .a = 0});
  loop.ExpectSilence(true);
  if (auto flow = loop.RunFor(cycle.off_s); !flow) return flow;
  if (const Status on = loop.bench().power->SetOn(true, deadline()); !on) {
    return Stop(Halt::Why::kRigFault, on.error().message);
  }
  loop.log().WriteEvent({.kind = EventItem::Kind::kPower, .a = 1});
  if (auto flow = WaitForBoot(loop, boots); !flow) return flow;
  loop.ExpectSilence(false);
  if (const Status dated = loop.bench().board.SendDate(loop.bench().clock.utc()); !dated) {
    return Stop(Halt::Why::kRigFault, dated.error().message);
  }
  return loop.ReadTable(kTableAfterBoot);
}

Flow RunStep(BenchLoop& loop, const DateStep& date) {
  if (!loop.bench().advance_date) {
    return Stop(Halt::Why::kRigFault, "this bench cannot move the date: its clock is the real one");
  }
  loop.bench().advance_date(FromSeconds(date.advance_days * kDay_s));
  if (const Status dated = loop.bench().board.SendDate(loop.bench().clock.utc()); !dated) {
    return Stop(Halt::Why::kRigFault, dated.error().message);
  }
  return loop.RunFor(kDateSettle_s);
}

}  // namespace zrobench
