#include "rig/profile/expectations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/key_names.h"

namespace zrobench {
namespace {

struct Argument {
  enum class Type { kNumber, kCount, kText, kCodes };
  std::string_view key;
  Type type;
  bool required;
  Range range;                       // kNumber, kCount, kCodes
  std::vector<std::string> allowed;  // kText
};
struct Check {
  std::string name;
  std::vector<Argument> arguments;
};

// Every check that a profile may ask for, and what it takes.
const std::vector<Check>& Checks() {
  using enum Argument::Type;
  const Range degc = Range::Between(-100, 200), code = Range::Between(1, 16);
  const Range decision = Range::Between(1, 41), count = Range::Between(0, 1e6);
  const Argument from{"from_degc", kNumber, true, degc, {}};
  const Argument to{"to_degc", kNumber, true, degc, {}};
  const Argument within{"within_mdps", kNumber, true, Range::Between(0.001, 1e6), {}};
  static const std::vector<Check> checks = {
      {"table_coverage",
       {from,
        to,
        {"step_degc", kNumber, true, Range::Between(0.1, 50), {}},
        {"min_pct", kNumber, true, Range::Between(1, 100), {}}}},
      {"table_accuracy", {from, to, within}},
      {"granularity", {from, to, {"within_degc", kNumber, true, Range::Between(0.1, 200), {}}}},
      {"up_down", {within}},
      {"rejects",
       {{"codes", kCodes, false, code, {}},
        {"code", kCount, false, code, {}},
        {"during",
         kText,
         false,
         {},
         {"tone", "music", "sweep", "move", "tap", "rotate", "vibrate", "hand_held"}},
        {"at_least", kCount, false, Range::Between(1, 1e6), {}}}},
      {"decides",
       {{"codes", kCodes, false, decision, {}},
        {"code", kCount, false, decision, {}},
        {"at_least", kCount, false, count, {}},
        {"at_most", kCount, false, count, {}}}},
      {"no_unexpected_rejection", {{"at_most", kCount, true, count, {}}}},
      {"no_corrupt_entry", {within}},
      {"table_complete", {}},
      {"table_persists", {}},
      {"entry_age",
       {{"at_most_days", kCount, true, count, {}},
        {"from_degc", kNumber, false, degc, {}},
        {"to_degc", kNumber, false, degc, {}}}},
      {"lockstep", {}},
      {"residual_rate",
       {within,
        {"from_degc", kNumber, false, degc, {}},
        {"to_degc", kNumber, false, degc, {}},
        {"piece_s", kCount, false, Range::Between(2, 3600), {}}}},
      {"extrapolation_held", {{"beyond_degc", kNumber, true, Range::Between(0, 200), {}}, within}},
  };
  return checks;
}

bool ReadCodes(TableReader* reader, const Argument& argument, std::vector<double>* codes) {
  if (!reader->Numbers(argument.key, codes, argument.range, 1, 16)) return false;
  const auto whole = [](double code) { return code == std::floor(code); };
  if (std::all_of(codes->begin(), codes->end(), whole)) return true;
  reader->Complain(argument.key, fmt::format("{} must be whole numbers", argument.key));
  return false;
}

void ReadArgument(TableReader* reader, const Argument& argument, Expectation* expectation) {
  using enum Argument::Type;
  const std::string key(argument.key);
  double number = 0;
  std::size_t count = 0;
  std::string text;
  std::vector<double> codes;
  switch (argument.type) {
    case kNumber:
      if (reader->Number(key, &number, argument.range)) {
        expectation->arguments.emplace_back(key, number);
      }
      break;
    case kCount:
      if (!reader->Count(key, &count, argument.range)) break;
      number = static_cast<double>(count);
      if (key == "code") {
        expectation->arguments.emplace_back("codes", std::vector<double>{number});
      } else {
        expectation->arguments.emplace_back(key, number);
      }
      break;
    case kText:
      if (reader->Choice(key, &text, argument.allowed)) {
        expectation->arguments.emplace_back(key, text);
      }
      break;
    case kCodes:
      if (ReadCodes(reader, argument, &codes)) expectation->arguments.emplace_back(key, codes);
      break;
  }
  if (argument.required) reader->Require({argument.key});
}

Expectation ReadCheck(const Check& check, TableReader reader) {
  Expectation expectation{check.name, {}, reader.place().line};
  for (const Argument& argument : check.arguments) ReadArgument(&reader, argument, &expectation);
  reader.RefuseOtherKeys();
  const auto holds = [&](std::string_view key) { return reader.table()->contains(key); };
  if (holds("code") && holds("codes")) reader.Complain("code", "give either code or codes");
  const bool counted = holds("at_least") || holds("at_most");
  if (check.name == "decides" && !(counted && (holds("code") || holds("codes")))) {
    reader.Complain("", "decides wants code or codes, and at_least or at_most");
  }
  const double from = expectation.number("from_degc", -HUGE_VAL);
  const double to = expectation.number("to_degc", HUGE_VAL);
  if (from >= to) {
    reader.Complain("from_degc", fmt::format("from_degc = {} is not below to_degc = {}", from, to));
  }
  return expectation;
}

}  // namespace

double Expectation::number(const std::string& key, double otherwise) const {
  for (const auto& [name, value] : arguments) {
    if (name != key) continue;
    if (const double* number = std::get_if<double>(&value)) return *number;
  }
  return otherwise;
}

std::optional<Expectation> ReadExpectation(TableReader* expect) {
  std::optional<Expectation> expectation;
  int found = 0;
  for (const Check& check : Checks()) {
    if (!expect->Has(check.name)) continue;
    if (++found > 1) {
      expect->Complain(check.name, fmt::format("an expectation names one check; '{}' wants its own "
                                               "[[expect]]",
                                               check.name));
    }
    const TableReader table = expect->Table(check.name);
    if (table.present()) expectation = ReadCheck(check, table);
  }
  expect->RefuseOtherKeys();
  if (expect->keys().empty()) expect->Complain("", "this [[expect]] names no check");
  return expectation;
}

}  // namespace zrobench
