// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
/** npm run serve: the synthetic mission at eight times real time on port 8765, again from its start when it ends. */
import { kDuration_s } from "./mine";
import { SyntheticServer } from "./server";

const server = new SyntheticServer(true);
await server.listen(8765);
console.log("http://127.0.0.1:8765/  token: synthetic");
let t = 0;
setInterval(() => { if (t <= kDuration_s) server.publish(t++); }, 125);
