/* Put on top of each file that mutants.py changes. SPDX-License-Identifier: MIT */
#ifndef KNURL_MUTANT_H
#define KNURL_MUTANT_H

#ifdef __cplusplus
extern "C" {
#endif
extern int knurl_mutant;                /* the number of the mutant that runs; 0: the original code */
extern unsigned char *knurl_mutant_met; /* by number: 1 if it was reached */
#ifdef __cplusplus
}
#endif
#define KNURL_MUTANT(n) (knurl_mutant_met[n] = 1, knurl_mutant == (n))

#endif
