// SPDX-License-Identifier: Apache-2.0
// Pages of evidence that GoogleTests measure: one row per test `FAMILY/SUITE.Full/NAME`, called
// `FAMILY/NAME`. The section is the family. The properties that the test records are the columns.
#pragma once

#include "evidence/measured.hpp"

namespace halfway::page {

/// Run the tests of the program. With `--evidence`, run the tests of the rows that are not measured, and
/// write the page; `--part=TEXT` selects rows with this text in their names. `page.rows` are taken from the
/// tests.
int run_tests(int argc, char** argv, Page page);

}  // namespace halfway::page
