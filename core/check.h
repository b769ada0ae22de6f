#pragma once
// Contract bugs throw; errors of the world are values (core/result.h).
#include <stdexcept>
#include <string>

namespace zrobench {

[[noreturn]] inline void ThrowContractBroken(const char* expression, const char* file, int line) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) +
                         ": contract broken: " + expression);
}

}  // namespace zrobench

/// Throws std::logic_error when a caller inside the program broke a promise.
#define ZROBENCH_CHECK(condition)     \
  ((condition) ? static_cast<void>(0) \
               : ::zrobench::ThrowContractBroken(#condition, __FILE__, __LINE__))
