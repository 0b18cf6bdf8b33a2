// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A target must have a source; this one has precompiled headers (AditTargets.cmake).
