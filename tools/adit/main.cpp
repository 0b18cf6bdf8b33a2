// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/adit_app.hpp"

int main(int argc, char** argv) { return adit::run_adit(argc, argv); }
