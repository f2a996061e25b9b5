/* Knurl: haptic gratings on force-feedback devices. This header includes all the others.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_KNURL_H
#define KNURL_KNURL_H

#include <knurl/audio.h>
#include <knurl/base.h>
#include <knurl/contact.h>
#include <knurl/device.h>
#include <knurl/device_functions.h>
#include <knurl/effect.h>
#include <knurl/fake.h>
#include <knurl/gltf.h>
#include <knurl/grating.h>
#include <knurl/hip.h>
#include <knurl/loop.h>
#include <knurl/motion.h>
#include <knurl/query.h>
#include <knurl/scene.h>
#include <knurl/stroke.h>
#include <knurl/vibration.h>

#endif
