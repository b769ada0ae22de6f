#include "core/toml_reader.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "core/text_file.h"
#include "tests/unit/core/toml_text.h"

namespace zrobench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// What `read` complains about in `text`, without the file's name.
template <typename Read>
std::vector<std::string> Complaints(const std::string& text, Read read) {
  const TextFile file(text);
  const auto toml = ReadToml(file.path());
  if (!toml) return LinesWithoutPath(toml.error().message, file.path());
  Diagnostics diagnostics(file.path().string());
  read(TableReader(&toml->root, "the file", &diagnostics));
  return LinesWithoutPath(diagnostics.error().message, file.path());
}

TEST(TomlReader, EveryFaultComesOutInFileOrder) {
  const auto faults = Complaints("b = 'x'\na = 11\nc = [1, 'two']\nnaem = 1\n", [](TableReader r) {
    double a = 5;
    bool b = true;
    std::string name;
    std::vector<double> c{7};
    EXPECT_FALSE(r.Number("a", &a, Range::Between(0, 10)));
    EXPECT_FALSE(r.Flag("b", &b));
    EXPECT_FALSE(r.Numbers("c", &c, Range::Any(), 1, 4));
    r.Text("name", &name);
    r.RefuseOtherKeys();
    EXPECT_EQ(a, 5);
    EXPECT_TRUE(b);
    EXPECT_THAT(c, ElementsAre(7));
  });
  EXPECT_THAT(faults, ElementsAre("1:5: error: b must be true or false, not a text",
                                  "2:5: error: a = 11 is above 10",
                                  "3:9: error: c[1] must be a number, not a text",
                                  HasSubstr("4:1: error: 'naem' is not a key of the file; "
                                            "did you mean 'name'?")));
}

TEST(TomlReader, IntegersOfAnySizeAreNumbers) {
  const auto faults = Complaints("a = 9223372036854775807\nb = -3\n", [](TableReader r) {
    double value = 0;
    EXPECT_TRUE(r.Number("a", &value, Range::Any()));
    EXPECT_DOUBLE_EQ(value, 9223372036854775807.0);
    EXPECT_TRUE(r.Number("b", &value, Range::Any()));
    EXPECT_EQ(value, -3);
  });
  EXPECT_THAT(faults, ElementsAre());
}

TEST(TomlReader, WhatIsNoFiniteNumberIsRefusedAtItsPlace) {
  double value = 1;
  const auto read = [&](TableReader r) { r.Number("a", &value, Range::Any()); };
  EXPECT_THAT(Complaints("a = nan", read), ElementsAre("1:5: error: a must be a finite number"));
  EXPECT_THAT(Complaints("a = -inf", read), ElementsAre("1:5: error: a must be a finite number"));
  EXPECT_THAT(Complaints("a = 1e400", read), ElementsAre(HasSubstr("1:")));
  EXPECT_THAT(Complaints("a = 99999999999999999999", read), ElementsAre(HasSubstr("1:")));
  EXPECT_EQ(value, 1);
}

TEST(TomlReader, CountsAreWholeAndCharactersSingle) {
  std::size_t count = 7;
  char character = ',';
  const auto faults =
      Complaints("a = 1.5\nb = 3.0\nc = '--'\nd = ';'\ne = ''\n", [&](TableReader r) {
        EXPECT_FALSE(r.Count("a", &count, Range::Between(0, 10)));
        EXPECT_EQ(count, 7u);
        EXPECT_TRUE(r.Count("b", &count, Range::Between(0, 10)));
        EXPECT_FALSE(r.Character("c", &character));
        EXPECT_EQ(character, ',');
        EXPECT_TRUE(r.Character("d", &character));
        EXPECT_FALSE(r.Character("e", &character));
      });
  EXPECT_EQ(count, 3u);
  EXPECT_EQ(character, ';');
  EXPECT_THAT(faults, ElementsAre("1:5: error: a must be a whole number",
                                  "3:5: error: c must be one character",
                                  "5:5: error: e must be one character"));
}

TEST(TomlReader, DatesKeepTheirZoneAndStayInRange) {
  const auto utc_of = [](const std::string& value) {
    const toml::table table = toml::parse("date = " + value);
    return UtcOf(*table.get("date"));
  };
  const auto noon = utc_of("2026-01-01T12:00:00Z");
  ASSERT_TRUE(noon);
  EXPECT_EQ(utc_of("2026-01-01T14:00:00+02:00"), noon);
  EXPECT_EQ(utc_of("2026-01-01T12:00:00"), noon);  // no zone: UTC
  EXPECT_EQ(utc_of("'2026-01-01T10:30:00-01:30'"), noon);
  EXPECT_EQ(utc_of("1969-12-31"), std::nullopt);
  EXPECT_EQ(utc_of("2201-01-01"), std::nullopt);
  EXPECT_EQ(utc_of("12:00:00"), std::nullopt);  // a time of no day
  EXPECT_EQ(utc_of("'soon'"), std::nullopt);
  EXPECT_EQ(utc_of("\"2026-01-01\\nx = 1\""), std::nullopt);
  EXPECT_EQ(utc_of("20260101"), std::nullopt);
}

TEST(TomlReader, HostileNestingIsAnErrorNotACrash) {
  const auto nothing = [](const TableReader&) {};
  const std::string deep = "a = " + std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_THAT(Complaints(deep, nothing), ElementsAre(HasSubstr("1:")));
  std::string dotted = "a";
  for (int i = 0; i < 100'000; ++i) dotted += ".a";
  EXPECT_THAT(Complaints(dotted + " = 1", nothing), ElementsAre(HasSubstr("1:")));
  EXPECT_THAT(Complaints("[" + dotted + "]\nb = 1", nothing), ElementsAre(HasSubstr("1:")));
  EXPECT_THAT(Complaints("a = \"\xff\"", nothing), ElementsAre(HasSubstr("invalid utf-8")));
}

TEST(ReadTextFile, FoldersAndEndlessFilesAreRefused) {
  const auto folder = ReadTextFile(testing::TempDir());
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().kind, Error::Kind::kFile);
  EXPECT_THAT(folder.error().message, HasSubstr("cannot read it: is a directory"));
  const auto endless = ReadTextFile("/dev/zero");
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().message, "/dev/zero: error: cannot read it: is larger than 16 MiB");
  EXPECT_EQ(ReadTextFile("/dev/null"), "");
}

}  // namespace
}  // namespace zrobench
