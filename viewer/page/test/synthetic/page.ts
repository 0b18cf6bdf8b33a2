// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** The page as it was built, named by ADIT_PAGE. */
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

export function builtPage(): string {
  return readFileSync(process.env.ADIT_PAGE ?? fileURLToPath(new URL("../../dist/page.html", import.meta.url)), "utf8");
}
