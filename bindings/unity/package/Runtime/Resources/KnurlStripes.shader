// Draws a grating's ridges and grooves over a mesh, at the places where they are felt. uv: phases along the surface's x and
// y, in cycles, from KnurlStripes.cs. The pass has no LightMode: the built-in pipeline draws it, and URP and HDRP as
// SRPDefaultUnlit. SPDX-License-Identifier: MIT
Shader "Knurl/Stripes"
{
    Properties
    {
        _Ridge ("Ridge", Color) = (1, 0.95, 0.85, 0.2)
        _Groove ("Groove", Color) = (0.03, 0.04, 0.08, 0.65)
    }
    SubShader
    {
        Tags { "Queue" = "Transparent" "RenderType" = "Transparent" "IgnoreProjector" = "True" }
        Pass
        {
            Blend SrcAlpha OneMinusSrcAlpha
            ZWrite Off
            Offset -1, -1

            HLSLPROGRAM
            #pragma vertex vert
            #pragma fragment frag
            #pragma multi_compile_instancing
            #include "UnityCG.cginc"
            #include "KnurlStripes.hlsl"

            float4 _Ridge;
            float4 _Groove;

            struct Corner
            {
                float4 vertex : POSITION;
                float2 cycles : TEXCOORD0;
                UNITY_VERTEX_INPUT_INSTANCE_ID
            };

            struct Pixel
            {
                float4 vertex : SV_POSITION;
                float2 cycles : TEXCOORD0;
                UNITY_VERTEX_OUTPUT_STEREO
            };

            Pixel vert(Corner corner)
            {
                Pixel made;
                UNITY_SETUP_INSTANCE_ID(corner);
                UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(made);
                made.vertex = UnityObjectToClipPos(corner.vertex);
                made.cycles = corner.cycles;
                return made;
            }

            float4 frag(Pixel pixel) : SV_Target
            {
                float height = KnurlHeight(pixel.cycles, fwidth(pixel.cycles));
                return lerp(_Groove, _Ridge, 0.5 + 0.5 * height);
            }
            ENDHLSL
        }
    }
}
