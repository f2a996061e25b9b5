// SPDX-License-Identifier: MIT
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl.Samples
{
    /// <summary>Colours its object in any render pipeline. A quad with a <see cref="KnurlSurface"/>
    /// also gets a picture of its ridges, light where they are high.</summary>
    [RequireComponent(typeof(Renderer))]
    public sealed class KnurlPaint : MonoBehaviour
    {
        const int Pixels = 512;
        const float Groove = 0.5f; // the grooves' share of the ridges' brightness

        [SerializeField, Tooltip("Of the object; of a plate's ridges")]
        Color color = new Color(0.88f, 0.88f, 0.88f);

        Material material;
        Texture2D ridges;

        /// <summary>Colour of the object, or of a plate's ridges. Set it before the component starts.</summary>
        public Color Color
        {
            get { return color; }
            set { color = value; }
        }

        void Start()
        {
            var painted = GetComponent<Renderer>();
            RenderPipelineAsset pipeline = GraphicsSettings.currentRenderPipeline; // null: the built-in one
            Shader shader = pipeline != null ? pipeline.defaultShader : null;
            material = shader != null ? new Material(shader) : painted.material;
            painted.material = material;
            material.color = color;
            var surface = GetComponent<KnurlSurface>();
            if (surface != null && surface.Grating != null)
            {
                material.mainTexture = ridges = Draw(surface.Grating, transform.lossyScale);
            }
        }

        void OnDestroy()
        {
            Destroy(ridges); // not the material's texture, which may be a project asset
            Destroy(material);
        }

        /// <summary>size: the quad's, m.</summary>
        static Texture2D Draw(KnurlGrating grating, Vector2 size)
        {
            var texture = new Texture2D(Pixels, Pixels, TextureFormat.RGBA32, true);
            var pixels = new Color32[Pixels * Pixels];
            float cos = Mathf.Cos(grating.Orientation);
            float sin = Mathf.Sin(grating.Orientation);
            Vector2 turn = 2f * Mathf.PI * grating.SpatialFrequency; // rad/m
            for (int i = 0; i < pixels.Length; i++)
            {
                float u = size.x * ((i % Pixels + 0.5f) / Pixels - 0.5f); // m from the middle
                float v = size.y * ((i / Pixels + 0.5f) / Pixels - 0.5f);
                float waves = Mathf.Cos(turn.x * (cos * u + sin * v)) * Mathf.Cos(turn.y * (cos * v - sin * u));
                byte light = (byte)(255f * (waves >= 0f ? 1f : Groove));
                pixels[i] = new Color32(light, light, light, 255);
            }
            texture.anisoLevel = 8;
            texture.SetPixels32(pixels);
            texture.Apply();
            return texture;
        }
    }
}
