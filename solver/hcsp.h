// SPDX-License-Identifier: Apache-2.0
// Everything a program that embeds hcsp needs: domains, Problem, Result.
#pragma once

#include "domains/box.h"
#include "domains/interval/interval.h"
#include "domains/lattice.h"
#include "domains/set_interval.h"
#include "domains/tube.h"
#include "solver/problem.h"
#include "solver/result.h"
