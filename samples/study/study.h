/* The studies: each computes the numbers of a figure of the paper or of a chart of this project. A study writes
 * DIR/NAME.csv (a header, then rows) and DIR/NAME.json (results); figures.py draws them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_H
#define KNURL_STUDY_H

#include "metrics.h"
#include "study_out.h"

/** One study. Progress goes to stderr if that is a terminal. */
typedef struct study {
    const char *name;
    const char *about;              /**< one line, for the help */
    int (*run)(const char *folder); /**< 0: done; 1: failed, after printing the reason in one line on stderr */
} study;

/** All of them, in the paper's order, ended by a null name (studies.c). */
extern const study studies[];

int study_signals(const char *folder);     /* figure 2 */
int study_coverage(const char *folder);    /* figure 3 */
int study_temporal(const char *folder);    /* figure 4 */
int study_device(const char *folder);      /* figure 11 */
int study_gratings(const char *folder);    /* figure 6 and section III */
int study_preferences(const char *folder); /* figure 8 and Experiment 3 */
int study_tradeoff(const char *folder);    /* cost against accuracy */
int study_tracking(const char *folder);    /* several methods to track a position in counts; prints its table */
int study_velocity(const char *folder);    /* the velocity estimators, to choose the default */
int study_even(const char *folder);        /* gains for even sensation; prints them */
int study_half_cycles(const char *folder); /* every half cycle's impulse, on facets too; prints its table */
int study_smooth(const char *folder);      /* a ring's triangles against its normals; prints its table */
int study_creases(const char *folder);     /* one force however a crease is cut; prints its table */
int study_transitions(const char *folder); /* turns, stops, lift-off, changes in an event; prints its table */
int study_failures(const char *folder);    /* failures of methods; also writes failures.md */
int study_stability(const char *folder);   /* runaways of walls and gratings; prints its checks */

#endif
