#include "rig/cli/program.h"

int main(int argc, char** argv) { return zrobench::RunCommandLine(argc, argv); }
