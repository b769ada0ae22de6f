// blind_baselines --cases DIR --sealed DIR2: writes answer files beside each case, one a method.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/blind/baselines.h"

namespace zrobench::blind {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void Write(const fs::path& path, const Named& named) {
  json terms = json::array();
  for (const std::string& id : named) terms.push_back({{"id", id}});
  const json said = {{"schema", 1},
                     {"verdict", named.empty() ? "no_missing_physics" : "named"},
                     {"mismatch", {{"detected", !named.empty()}}},
                     {"terms", terms},
                     {"ambiguity", json::array()}};
  std::ofstream(path) << said.dump(1) << "\n";
}

std::vector<std::string> TruthOf(const fs::path& label) {
  const json parsed = json::parse(std::ifstream(label));
  std::vector<std::string> ids;
  for (const json& effect : parsed["effects"]) ids.push_back(effect["id"]);
  return ids;
}

double Judge(const fs::path& folder, const fs::path& label) {
  const Recording recording = ReadCase(folder);
  Bench bench = recording.bench;
  bench.actual = FittedModel(recording);
  const Yardstick yard(bench, recording.campaign);
  const Eigen::VectorXd residual = recording.stacked - yard.reference();
  const BaseFit fit{recording, yard, residual, yard.Project(residual)};
  Write(folder / "correlation.json", ByCorrelation(fit));
  Write(folder / "stlsq.json", ByStlsq(fit));
  Write(folder / "likelihood_ratio.json", ByLikelihoodRatio(fit));
  Write(folder / "oracle.json", Oracle(fit, TruthOf(label)));
  return RidgeHeldOutShare(fit);
}

void JudgeAll(const fs::path& cases, const fs::path& sealed) {
  std::vector<double> shares;
  std::ifstream list(sealed / "hashes.txt");
  for (std::string hash, name; list >> hash >> name;) {
    shares.push_back(Judge(cases / name, sealed / name / "label.json"));
    std::cout << name << "\n" << std::flush;
  }
  if (shares.empty()) throw std::runtime_error((sealed / "hashes.txt").string() + ": no cases");
  std::ranges::sort(shares);
  fmt::print(
      "ridge on (T, dT/dt, t): leaves {:.2f} of the gyro's error in the held-out run, median"
      " of {}; it names nothing\n",
      shares[shares.size() / 2], shares.size());
}

}  // namespace
}  // namespace zrobench::blind

int main(int argc, char** argv) {
  CLI::App app(
      "What simpler methods answer: correlation.json, stlsq.json, likelihood_ratio.json,\n"
      "oracle.json beside each case, for blind_score.py --answer NAME.\n"
      "  blind_baselines --cases cases --sealed labels");
  std::filesystem::path cases, sealed;
  app.add_option("--cases", cases, "folder of the cases")->required();
  app.add_option("--sealed", sealed, "folder of the labels, for the oracle alone")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    zrobench::blind::JudgeAll(cases, sealed);
  } catch (const std::exception& problem) {
    std::cerr << "blind_baselines: " << problem.what() << "\n";
    return 1;
  }
  return 0;
}
