// SPDX-License-Identifier: MIT
using System;
using System.Threading.Tasks;

namespace Knurl
{
    /// <summary>Work with devices that takes longer than a frame: on another thread, one after the other, because a device
    /// has to be closed before it can be opened again.</summary>
    internal static class Background
    {
        static Task latest = Task.FromResult(0);

        /// <summary>Main thread. The work throws only what its task hands on.</summary>
        internal static Task<T> Run<T>(Func<T> work)
        {
            Task<T> next = latest.ContinueWith(_ => work(), TaskScheduler.Default);
            latest = next;
            return next;
        }

        /// <summary>Main thread. Returns once all of it is done.</summary>
        internal static void Wait()
        {
            ((IAsyncResult)latest).AsyncWaitHandle.WaitOne(); // throws nothing of the work's
        }
    }
}
