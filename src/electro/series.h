/* The fields that the materials between two electrodes see: a plane capacitor of two insulators and a gap of liquid in
 * series, whatever the law of attraction makes of them. Theory, eq. (4.10). */
#ifndef ZP_ELECTRO_SERIES_H
#define ZP_ELECTRO_SERIES_H

/* Two insulators, of which the weaker one, which breaks down first, is the same at any voltage and gap. */
typedef struct ZpSeriesParams {
  double thickness;  /* of both over their relative permittivities, t_1 / eps_1 + t_2 / eps_2, m */
  double eps_i;      /* relative permittivity of the weaker one */
  double withstands; /* and its dielectric strength, V/m */
  double eps_m;      /* relative permittivity of the liquid */
} ZpSeriesParams;

typedef struct ZpSeries {
  double insulator, liquid; /* V/m, in the weaker insulator; NAN: there is none between the metals */
} ZpSeries;

/* At `voltage` (V, any sign) with this distance of the faces (m; below 0: none). */
ZpSeries zp_series_at(const ZpSeriesParams *params, double voltage, double gap);

/* The voltage at which the weaker insulator between closed faces breaks down, V; 0: there is none. */
double zp_series_allowed(const ZpSeriesParams *params);

#endif
