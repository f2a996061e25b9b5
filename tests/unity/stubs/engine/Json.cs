// Test-only stand-ins, never shipped.
using System;
using System.Web.Script.Serialization;

namespace UnityEngine
{
    /// Faithful: public fields by their names, what is not there keeps what its constructor gave, what has no field is
    /// passed over. Not: Unity's own types, private fields, a limit of depth.
    public static class JsonUtility
    {
        public static T FromJson<T>(string json)
        {
            try
            {
                return new JavaScriptSerializer { MaxJsonLength = int.MaxValue }.Deserialize<T>(json);
            }
            catch (ArgumentException e)
            {
                throw new ArgumentException("JSON parse error: " + e.Message);
            }
        }
    }
}
