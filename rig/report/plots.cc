#include "rig/report/plots.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "rig/report/sections.h"
#include "rig/report/thin.h"

namespace zrobench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxRows = 4000;
constexpr double kMilli = 1e3;

/// To `per_unit` steps a unit: what is beyond the sensors' resolution only makes the file long.
Json Rounded(double value, double per_unit) {
  return std::isfinite(value) ? Json(std::round(value * per_unit) / per_unit) : Json(nullptr);
}
Json Mdps(double dps) { return Rounded(dps * kMilli, 100); }
Json Mdps(const std::array<double, 3>& dps) { return {Mdps(dps[0]), Mdps(dps[1]), Mdps(dps[2])}; }

template <std::size_t N>
Json RowsJson(const std::vector<std::array<double, N>>& rows) {
  Json out = Json::array();
  for (const auto& row : Thinned(rows, kMaxRows)) {
    Json line = Json::array();
    for (const double value : row) line.push_back(Rounded(value, 1e5));
    out.push_back(std::move(line));
  }
  return out;
}

Json TemperaturesJson(const History& history) {
  std::vector<std::array<double, 4>> rows;
  for (const auto& p : history.plate) {
    rows.push_back({p.t_s, p.setpoint_degc, p.plate_degc, p.board_degc});
  }
  return RowsJson(rows);
}

/// t, raw x y z, corrected x y z [dps]; a row of gaps where a second or more is missing.
Json RatesJson(const History& history) {
  constexpr double kGap_s = 1.5;
  std::vector<std::array<double, 7>> rows;
  for (const auto& s : history.seconds) {
    if (!rows.empty() && s.t_s - rows.back()[0] > kGap_s) {
      rows.push_back({rows.back()[0] + 1, NAN, NAN, NAN, NAN, NAN, NAN});
    }
    rows.push_back({s.t_s, s.raw_dps[0], s.raw_dps[1], s.raw_dps[2], s.rate_dps[0], s.rate_dps[1],
                    s.rate_dps[2]});
  }
  return RowsJson(rows);
}

/// The rig's own raw means, board's temperature and x y z [dps], of the quiet seconds.
Json CloudJson(const History& history) {
  std::vector<std::array<double, 4>> rows;
  for (const auto& s : history.seconds) {
    if (s.quiet) rows.push_back({s.board_degc, s.raw_dps[0], s.raw_dps[1], s.raw_dps[2]});
  }
  return RowsJson(rows);
}

Json EntriesJson(const zro::Table& table) {
  Json out = Json::array();
  for (int i = 0; i < table.size(); ++i) {
    const zro::Entry& e = table[i];
    out.push_back({{"degc", Rounded(double{e.temp_degc}, 1e3)},
                   {"zro_mdps", Mdps(std::array{double{e.zro_dps[0]}, double{e.zro_dps[1]},
                                                double{e.zro_dps[2]}})},
                   {"sigma_mdps", Mdps(double{e.sigma_dps})},
                   {"weight", e.weight},
                   {"origin", e.origin == zro::Origin::kFactory ? "factory" : "learned"}});
  }
  return out;
}

Json ReadingJson(const History::Reading& reading) {
  const Decision& d = reading.decision;
  const char* const fate = zro::IsRejection(d.code) ? "refused"
                           : IsAccepted(d.code)     ? "accepted"
                                                    : "other";
  return {{"t_s", Rounded(reading.t_s, 1e3)},
          {"degc", Rounded(d.temp_degc, 1e3)},
          {"code", static_cast<int>(d.code)},
          {"name", CodeName(d.code)},
          {"fate", fate},
          {"axis", d.axis < 3 ? Json(std::string(1, "xyz"[d.axis])) : Json(nullptr)},
          {"measured_mdps", Mdps(d.measured_dps)},
          {"value", Rounded(d.value, 1e4)},
          {"limit", Rounded(d.limit, 1e4)},
          {"stimulus", reading.stimulus}};
}

Json StimuliJson(const History& history) {
  Json out = Json::array();
  for (const auto& s : history.stimuli) {
    out.push_back({{"from_s", Rounded(s.from_s, 1e3)},
                   {"to_s", Rounded(s.to_s, 1e3)},
                   {"kind", s.kind},
                   {"hz", s.hz},
                   {"spl_db", s.spl_db}});
  }
  return out;
}

Json LoadsJson(const History& history) {
  Json out = Json::array();
  for (const auto& load : history.loads) {
    out.push_back({{"from_s", Rounded(load.from_s, 1e3)},
                   {"to_s", Rounded(load.to_s, 1e3)},
                   {"kind", fmt::format("load {:g} %", load.duty_pct)}});
  }
  return out;
}

Json TonesJson(const History& history) {
  Json out = Json::array();
  for (const auto& t : history.tones) {
    out.push_back({{"hz", t.hz},
                   {"spl_db", t.spl_db},
                   {"from_s", Rounded(t.from_s, 1e3)},
                   {"to_s", Rounded(t.to_s, 1e3)},
                   {"degc", Rounded(t.board_degc, 1e3)},
                   {"shift_mdps", Mdps(t.shift_dps)},
                   {"band_hz", t.band_hz},
                   {"decisions", DecisionsText(t)}});
  }
  return out;
}

}  // namespace

std::string PlotsJson(const History& history) {
  Json readings = Json::array();
  for (const auto& reading : history.readings) readings.push_back(ReadingJson(reading));
  const Json plots = {{"duration_s", Rounded(history.duration_s, 1e3)},
                      {"temperatures", TemperaturesJson(history)},
                      {"rates", RatesJson(history)},
                      {"cloud", CloudJson(history)},
                      {"entries", EntriesJson(history.table)},
                      {"readings", std::move(readings)},
                      {"stimuli", StimuliJson(history)},
                      {"loads", LoadsJson(history)},
                      {"tones", TonesJson(history)}};
  std::string text;
  for (const char c : plots.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";  // no text of a record can end the script element
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace zrobench
