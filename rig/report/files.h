#pragma once
#include "core/result.h"
#include "rig/record/run_folder.h"

namespace zrobench {

/// Writes report.txt, report.html and junit.xml of a run into its folder, from its record and
/// manifest; earlier ones are replaced. kFile when the record cannot be read or the folder not
/// written. Blocks on the disk.
Status WriteReports(const RunFolder& folder, const RunManifest& manifest);

}  // namespace zrobench
