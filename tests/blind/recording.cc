#include "tests/blind/recording.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace zrobench::blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kBlank = std::numeric_limits<double>::quiet_NaN();

double CellOf(const std::string& cell, const std::filesystem::path& path) {
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (problem != std::errc() || end != cell.data() + cell.size()) {
    throw std::runtime_error(fmt::format("{}: '{}' is no number", path.string(), cell));
  }
  return value;
}

// Columns by name; the first row (t = 0) has set point and stimuli only.
std::map<std::string, VectorXd> Columns(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  std::vector<std::string> names;
  if (!std::getline(in, line)) throw std::runtime_error(path.string() + ": cannot be read");
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::map<std::string, VectorXd> columns;
  for (const std::string& name : names) columns[name] = VectorXd::Constant(kRunRows + 1, kBlank);
  Index row = 0;
  for (; std::getline(in, line) && row <= kRunRows; ++row) {
    std::istringstream cells(line);
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ',') && column < names.size(); ++column) {
      if (!cell.empty()) columns[names[column]][row] = CellOf(cell, path);
    }
  }
  if (row != kRunRows + 1) {
    throw std::runtime_error(fmt::format("{}: {} rows, not {}", path.string(), row, kRunRows + 1));
  }
  return columns;
}

// Means since the previous row, blanks bridged by a straight line.
VectorXd Means(const VectorXd& column) {
  VectorXd means = column.tail(kRunRows);
  Index last = -1;
  for (Index row = 0; row < kRunRows; ++row) {
    if (std::isnan(means[row])) continue;
    for (Index gap = last + 1; gap < row; ++gap) {
      const double from = last < 0 ? means[row] : means[last];
      const double part = static_cast<double>(gap - last) / static_cast<double>(row - last);
      means[gap] = from + part * (means[row] - from);
    }
    last = row;
  }
  return means;
}

// Shaking shows as scatter of the rows' means, a tenth of its rms.
VectorXd Shaking(const VectorXd& accel_g) {
  VectorXd shaking = VectorXd::Zero(kRunRows);
  constexpr Index kHalf = 10;
  for (Index row = kHalf + 1; row + kHalf < kRunRows; ++row) {
    const auto steps =
        accel_g.segment(row - kHalf, 2 * kHalf) - accel_g.segment(row - kHalf - 1, 2 * kHalf);
    const double rms = std::sqrt(steps.squaredNorm() / (4.0 * kHalf)) * 10;
    shaking[row] = rms > 0.05 && rms < 3 ? rms : 0;
  }
  return shaking;
}

Schedule StimuliOf(const std::map<std::string, VectorXd>& columns) {
  Schedule schedule;
  schedule.setpoint_degc = columns.at("setpoint_degc").head(kRunRows);
  schedule.tone_hz = columns.at("tone_hz").head(kRunRows);
  schedule.tone_spl_db = columns.at("tone_spl_db").head(kRunRows);
  schedule.supply_v = Means(columns.at("supply_v"));
  schedule.moving = VectorXd::Zero(kRunRows);
  schedule.gravity_g.resize(kRunRows, 3);
  const char* const axes[] = {"accel_x_g", "accel_y_g", "accel_z_g"};
  for (Index axis = 0; axis < 3; ++axis)
    schedule.gravity_g.col(axis) = Means(columns.at(axes[axis]));
  schedule.vibration_g = Shaking(schedule.gravity_g.col(2));
  return schedule;
}

Rows MeasuredIn(const std::map<std::string, VectorXd>& columns) {
  Rows rows{Means(columns.at("plate_degc")), Means(columns.at("imu_degc")),
            Eigen::MatrixXd(kRunRows, 3)};
  const char* const axes[] = {"gyro_x_dps", "gyro_y_dps", "gyro_z_dps"};
  for (Index axis = 0; axis < 3; ++axis) rows.gyro_dps.col(axis) = Means(columns.at(axes[axis]));
  return rows;
}

double Number(const toml::table& model, std::string_view table, std::string_view key) {
  const auto value = model[table][key].value<double>();
  if (!value) throw std::runtime_error(fmt::format("station.toml: no [model.{}] {}", table, key));
  return *value;
}

template <std::size_t N>
std::array<double, N> Numbers(toml::node_view<const toml::node> node, std::string_view key) {
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = node[i].template value<double>();
    if (!value) throw std::runtime_error(fmt::format("station.toml: {} lacks numbers", key));
    values[i] = *value;
  }
  return values;
}

Bench StationOf(const toml::table& file) {
  const toml::table* model = file["model"].as_table();
  if (!model) throw std::runtime_error("station.toml: no [model]");
  const auto number = [model](std::string_view table, std::string_view key) {
    return Number(*model, table, key);
  };
  Bench bench;
  BaseModel& m = bench.nominal;
  m.ambient_degc = number("ambient", "degc");
  m.plate_j_per_k = number("plate", "heat_capacity_j_per_k");
  m.heater_w = number("plate", "heater_w");
  m.cooler_w = number("plate", "cooler_w");
  m.plate_to_ambient_w_per_k = number("plate", "to_ambient_w_per_k");
  m.board_j_per_k = number("board", "heat_capacity_j_per_k");
  m.board_to_plate_w_per_k = number("board", "to_plate_w_per_k");
  m.board_to_ambient_w_per_k = number("board", "to_ambient_w_per_k");
  m.package_s = number("package", "time_constant_s");
  const toml::node_view<const toml::node> gyro = (*model)["gyro"];
  const char* const keys[] = {"zro_x_dps", "zro_y_dps", "zro_z_dps"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    m.zro_dps[axis] = Numbers<4>(gyro[keys[axis]], keys[axis]);
  }
  const auto terms = (*model)["term"];
  m.resonance_hz = Numbers<3>(terms["acoustic.resonance"]["resonance_hz"], "resonance_hz");
  m.resonance_q = terms["acoustic.resonance"]["q"].value_or(m.resonance_q);
  bench.knows_rectification = terms["acoustic.rectification"].is_table();
  if (bench.knows_rectification) {
    m.rectification_dps_per_pa2 =
        Numbers<3>(terms["acoustic.rectification"]["dps_per_pa2"], "dps_per_pa2");
  }
  bench.instruments.die_step_k = number("package", "resolution_degc");
  bench.instruments.die_noise_k = std::max(0.03, 0.56 * bench.instruments.die_step_k);
  bench.actual = bench.nominal;
  return bench;
}

}  // namespace

Recording ReadCase(const std::filesystem::path& folder) {
  std::ifstream in(folder / std::string_view("station.toml"));
  std::stringstream text;
  text << in.rdbuf();
  const toml::table file =
      toml::parse(std::string_view(text.view()), std::string_view("station.toml"));
  Recording recording{StationOf(file), {}, {}};
  std::vector<Rows> rows;
  for (int run = 1; std::filesystem::exists(folder / fmt::format("run-{}.csv", run)); ++run) {
    const auto columns = Columns(folder / fmt::format("run-{}.csv", run));
    Schedule schedule = StimuliOf(columns);
    schedule.started_h = file["recording"]["started_h"][fmt::format("run-{}", run)].value_or(0.0);
    recording.campaign.schedules.push_back(std::move(schedule));
    recording.campaign.command_pct.push_back(Means(columns.at("drive_pct")));
    rows.push_back(MeasuredIn(columns));
  }
  if (rows.empty()) throw std::runtime_error(folder.string() + ": no run-1.csv");
  recording.stacked = Stack(rows);
  return recording;
}

}  // namespace zrobench::blind
