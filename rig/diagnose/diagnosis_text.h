#pragma once
#include <string>

#include "rig/diagnose/diagnosis.h"

namespace zrobench::diagnose {

/// The report for a terminal: verdict, place, equation, numbers, rivals, limits.
std::string ToText(const Diagnosis& diagnosis, const std::string& name);

/// The catalogue: id, sentence, equation, parameters, source, look-alikes, excitation.
std::string CatalogueText();

}  // namespace zrobench::diagnose
