// SPDX-License-Identifier: MIT
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl.Samples
{
    /// <summary>Colours its object in any render pipeline.</summary>
    [RequireComponent(typeof(Renderer))]
    public sealed class KnurlPaint : MonoBehaviour
    {
        [SerializeField, Tooltip("Of the object")]
        Color color = new Color(0.88f, 0.88f, 0.88f);

        Material material;

        /// <summary>Colour of the object. Set it before the component starts.</summary>
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
        }

        void OnDestroy()
        {
            Destroy(material);
        }
    }
}
