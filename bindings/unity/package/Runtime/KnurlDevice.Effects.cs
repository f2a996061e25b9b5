// The effects that a KnurlDevice feels. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        static bool isWarnedOfEffects;

        [NonSerialized] readonly knurl_effect[] givenEffects = new knurl_effect[NativeMethods.KNURL_EFFECTS_MAX];
        [NonSerialized] uint givenCount;

        /// <summary>Passes the effects on its layers to the run, if they have changed since the last frame.</summary>
        unsafe void TellEffects()
        {
            knurl_effect* now = stackalloc knurl_effect[NativeMethods.KNURL_EFFECTS_MAX];
            uint count = CollectEffects(now);
            fixed (knurl_effect* given = givenEffects)
            {
                if (count == givenCount && IsSame(now, given, count))
                {
                    return;
                }
                givenCount = count; // also if they are refused: one error for each change is enough
                for (uint i = 0; i < count; i++)
                {
                    given[i] = now[i];
                }
            }
            Check("effects", NativeMethods.knurl_scene_set_effects(NativeMethods.knurl_session_get_scene(session), 0, now,
                count, Math.Min(Time.deltaTime, 1f)));
        }

        unsafe uint CollectEffects(knurl_effect* to)
        {
            uint count = 0;
            for (int i = 0; i < Registry.Effects.Count; i++)
            {
                KnurlEffect effect = Registry.Effects[i];
                if ((effect.Layers & layers) == 0)
                {
                    continue;
                }
                if (count == NativeMethods.KNURL_EFFECTS_MAX)
                {
                    WarnOfEffects(effect);
                    break;
                }
                effect.Describe(&to[count++]);
            }
            return count;
        }

        static void WarnOfEffects(KnurlEffect effect)
        {
            if (!isWarnedOfEffects)
            {
                isWarnedOfEffects = true;
                Debug.LogWarning("KnurlEffect '" + effect.name + "': expected at most " + NativeMethods.KNURL_EFFECTS_MAX
                    + " that a device feels at once, found more; the last are not felt: disable some, or use layers", effect);
            }
        }

        static unsafe bool IsSame(knurl_effect* a, knurl_effect* b, uint count)
        {
            ulong* left = (ulong*)a;
            ulong* right = (ulong*)b;
            ulong difference = 0;
            for (uint i = 0; i < count * sizeof(knurl_effect) / sizeof(ulong); i++)
            {
                difference |= left[i] ^ right[i];
            }
            return difference == 0;
        }

        /// <summary>A session with files outlives the run, and its scene keeps effects.</summary>
        unsafe void DropEffects()
        {
            if (session != null && givenCount > 0)
            {
                NativeMethods.knurl_scene_set_effects(NativeMethods.knurl_session_get_scene(session), 0, null, 0, 0.0);
            }
            givenCount = 0;
        }
    }
}
