#include "corrector/table.h"
#include "corrector/corrector.h"
#include <gtest/gtest.h>
TEST(Table, Size) { RecordProperty("s", int(sizeof(zro::Corrector))); printf("sizeof %zu\n", sizeof(zro::Corrector)); EXPECT_LE(sizeof(zro::Corrector), 2600u); }
