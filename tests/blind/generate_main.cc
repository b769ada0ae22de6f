// blind_generate --seed S --set smoke|full --out DIR --sealed DIR2
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tests/blind/case_set.h"
#include "tests/blind/seal.h"

namespace zrobench::blind {
namespace {

namespace fs = std::filesystem;

void Write(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

struct Places {
  fs::path cases, sealed;
};

// Returns the seal. The label is written first: a case without one would be unjudgeable.
std::string WriteCase(const CaseOrder& order, const std::string& name, std::uint64_t seed,
                      const Places& places) {
  const HiddenCase made = MakeCase(order, seed);
  const std::string label = LabelText(made, name);
  const std::string nonce = Nonce(Draw(seed, "nonce"));
  fs::create_directories(places.sealed / name);
  Write(places.sealed / name / "label.json", label);
  Write(places.sealed / name / "nonce", nonce);
  fs::create_directories(places.cases / name);
  Write(places.cases / name / "station.toml", StationText(made.bench, made.schedules));
  for (std::size_t run = 0; run < made.schedules.size(); ++run) {
    Write(places.cases / name / fmt::format("run-{}.csv", run + 1), RunText(made, run, seed));
  }
  return SealOf(label, nonce);
}

// Where a set was begun before, its finished cases and their hashes stand.
std::string EarlierSeals(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void Generate(std::uint64_t seed, const std::string& set, const Places& places) {
  const std::vector<CaseOrder> orders = OrdersOf(set, seed);
  fs::create_directories(places.cases);
  fs::create_directories(places.sealed);
  const fs::path list = places.sealed / "hashes.txt";
  std::string seals = EarlierSeals(list);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const std::string name = fmt::format("case-{:04}", i + 1);
    const std::size_t at = seals.find("  " + name + "\n");
    std::string line;
    if (at == std::string::npos) {
      const std::uint64_t own = Draw(seed, name).Bits();
      line = WriteCase(orders[i], name, own, places) + "  " + name + "\n";
      seals += line;
      Write(list, seals);
    } else {
      line = seals.substr(at - 64, 64) + "  " + name + "\n";
    }
    std::cout << line << std::flush;
  }
}

}  // namespace
}  // namespace zrobench::blind

int main(int argc, char** argv) {
  CLI::App app(
      "Generates cases with concealed effects; labels go to their own folder.\n"
      "  blind_generate --seed 7 --set smoke --out cases --sealed labels");
  std::uint64_t seed = 0;
  std::string set = "smoke";
  zrobench::blind::Places places;
  app.add_option("--seed", seed, "everything follows from it")->required();
  app.add_option("--set", set, "smoke (24 cases) or full (750)")
      ->check(CLI::IsMember({"smoke", "full"}));
  app.add_option("--out", places.cases, "folder of the cases")->required();
  app.add_option("--sealed", places.sealed, "folder of the labels")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    zrobench::blind::Generate(seed, set, places);
  } catch (const std::exception& problem) {
    std::cerr << "blind_generate: " << problem.what() << "\n";
    return 1;
  }
  return 0;
}
