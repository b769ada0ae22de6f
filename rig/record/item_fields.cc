#include "rig/record/item_fields.h"

#include <algorithm>

#include "core/check.h"

namespace zrobench {
namespace {

template <typename T>
struct Ulog;
template <>
struct Ulog<std::uint8_t> {
  static constexpr const char* kType = "uint8_t";
};
template <>
struct Ulog<std::int16_t> {
  static constexpr const char* kType = "int16_t";
};
template <>
struct Ulog<std::uint16_t> {
  static constexpr const char* kType = "uint16_t";
};
template <>
struct Ulog<std::int32_t> {
  static constexpr const char* kType = "int32_t";
};
template <>
struct Ulog<std::uint32_t> {
  static constexpr const char* kType = "uint32_t";
};
template <>
struct Ulog<std::uint64_t> {
  static constexpr const char* kType = "uint64_t";
};
template <>
struct Ulog<float> {
  static constexpr const char* kType = "float";
};
template <>
struct Ulog<double> {
  static constexpr const char* kType = "double";
};
template <>
struct Ulog<EventItem::Kind> : Ulog<std::uint8_t> {};

template <typename T>
std::string FieldText(const char* name, const T*) {
  return std::string(Ulog<T>::kType) + ' ' + name + ';';
}
template <typename T, std::size_t N>
std::string FieldText(const char* name, const std::array<T, N>*) {
  return std::string(Ulog<T>::kType) + '[' + std::to_string(N) + "] " + name + ';';
}
std::string FieldText(const char* name, const std::string*) {
  return "char[" + std::to_string(FieldCodec<std::string>::kBytes) + "] " + name + ';';
}
std::string FieldText(const char* name, const std::vector<std::uint8_t>*) {
  using Codec = FieldCodec<std::vector<std::uint8_t>>;
  return std::string("uint16_t ") + name + "_length;uint8_t[" + std::to_string(Codec::kCapacity) +
         "] " + name + ';';
}

template <typename T>
std::string FormatText() {
  std::string text = std::string(ItemLayout<T>::kName) + ':';
  std::apply(
      [&]<typename... M>(const ItemField<T, M>&... field) {
        ((text += FieldText(field.name, static_cast<const M*>(nullptr))), ...);
      },
      ItemLayout<T>::kFields);
  return text;
}

using Units = std::vector<std::pair<std::string, std::string>>;

void AddUnit(Units& units, const char* name, const std::string& unit) {
  const bool known = std::any_of(units.begin(), units.end(),
                                 [&](const auto& other) { return other.first == name; });
  if (!known && !unit.empty() && unit != "1") units.emplace_back(name, unit);
}

template <typename T>
void AddUnits(Units& units) {
  std::apply([&](const auto&... field) { (AddUnit(units, field.name, field.unit), ...); },
             ItemLayout<T>::kFields);
}

/// Bytes of `text` that fit, never half of a UTF-8 character.
std::size_t FittingBytes(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return most;
}

}  // namespace

void FieldCodec<std::string>::Pack(const std::string& value, std::uint8_t* to) {
  const std::size_t bytes = FittingBytes(value, kBytes - 1);
  std::memcpy(to, value.data(), bytes);
  std::memset(to + bytes, 0, kBytes - bytes);
}

void FieldCodec<std::string>::Unpack(std::string& value, const std::uint8_t* from) {
  const auto* const end = std::find(from, from + kBytes, 0);
  value.assign(from, end);
}

void FieldCodec<std::vector<std::uint8_t>>::Pack(const std::vector<std::uint8_t>& value,
                                                 std::uint8_t* to) {
  ZROBENCH_CHECK(value.size() <= kCapacity);
  const auto length = static_cast<std::uint16_t>(value.size());
  std::memcpy(to, &length, sizeof length);
  std::copy(value.begin(), value.end(), to + sizeof length);
  std::memset(to + sizeof length + length, 0, kCapacity - length);
}

void FieldCodec<std::vector<std::uint8_t>>::Unpack(std::vector<std::uint8_t>& value,
                                                   const std::uint8_t* from) {
  std::uint16_t length = 0;
  std::memcpy(&length, from, sizeof length);
  from += sizeof length;
  value.assign(from, from + std::min<std::size_t>(length, kCapacity));
}

const std::vector<std::string>& ItemFormats() {
  static const std::vector<std::string> formats =
      []<typename... T>(std::type_identity<std::tuple<T...>>) {
        return std::vector<std::string>{FormatText<T>()...};
      }(std::type_identity<DataItems>());
  return formats;
}

const std::vector<std::pair<std::string, std::string>>& ItemUnits() {
  static const Units units = []<typename... T>(std::type_identity<std::tuple<T...>>) {
    Units all;
    (AddUnits<T>(all), ...);
    return all;
  }(std::type_identity<DataItems>());
  return units;
}

}  // namespace zrobench
