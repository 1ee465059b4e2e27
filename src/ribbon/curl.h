/* Wide strips: a strip that is bent along its length also curls across it, the more the narrower it is and the less it
 * is bent. What curling saves of the energy of plane strain is W by the curvature, per length; docs/theory.md, eqs.
 * (2.5) to (2.7). */
#ifndef ZP_RIBBON_CURL_H
#define ZP_RIBBON_CURL_H

typedef struct ZpCurl {
  double EI;      /* what a narrow strip's bending stiffness lacks of plane strain, N m^2; 0: nothing curls */
  double squared; /* theta^4 over the square of the curvature, m^2 */
} ZpCurl;

/* W at a curvature, J/m, and its first two derivatives by it, N m and N m^2. */
typedef struct ZpCurlLaw {
  double W, M, K;
} ZpCurlLaw;

/* (strip, curvature 1/m of any sign) => the law there. */
ZpCurlLaw zp_curl_law(const ZpCurl *curl, double curvature);

/* Share of curling that a wide strip holds, 1 - f of eq. (2.6), at t = theta^4, over t; t times its first and t^2 times
 * its second derivative. */
typedef struct ZpCurlHeld {
  double value, first, second;
} ZpCurlHeld;
ZpCurlHeld zp_curl_held(double t);

/* Mean of M on the way from one curvature to another, (W1 - W0) / (curvature1 - curvature0), N m, and its derivative by
 * the latter, N m^2. */
typedef struct ZpCurlMean {
  double M, K;
} ZpCurlMean;

ZpCurlMean zp_curl_mean(const ZpCurl *curl, double curvature0, double curvature1);

#endif
