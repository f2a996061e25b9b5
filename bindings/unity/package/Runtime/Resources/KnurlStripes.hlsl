// A grating's height from its phases, for shaders. SPDX-License-Identifier: MIT

// The integral of a square wave that is +1 in the first half of each cycle and -1 in the second.
float KnurlIntegral(float cycles)
{
    return 0.5 - abs(frac(cycles) - 0.5);
}

// The sign of cos(2 pi cycles), averaged over a pixel: stripes finer than a pixel fade to grey and do not shimmer.
float KnurlWave(float cycles, float width)
{
    float phase = frac(cycles) + 0.25;
    return (KnurlIntegral(phase + 0.5 * width) - KnurlIntegral(phase - 0.5 * width)) / width;
}

// -1 to 1: the mean over a pixel. cycles: along the surface's x and y. width: their change over a pixel.
float KnurlHeight(float2 cycles, float2 width)
{
    width = max(width, float2(0.001, 0.001));
    return KnurlWave(cycles.x, width.x) * KnurlWave(cycles.y, width.y);
}
