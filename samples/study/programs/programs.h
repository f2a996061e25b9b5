/* The commands of knurl_study. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_PROGRAMS_H
#define KNURL_STUDY_PROGRAMS_H

int cmd_metrics(int argc, char **argv);
int cmd_study(int argc, char **argv);

#endif
