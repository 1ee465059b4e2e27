/* Files as instruments and spreadsheets write them, made up with the oddities of real ones: which lines are the table,
 * and what its numbers are. */
#include "files_util.h"

#include "io/data.h"
#include "io/units.h"

typedef struct Quantity {
  const char *stem, *unit;
  double first, last; /* SI */
} Quantity;

typedef struct Layout {
  const char *text, *renamed, *told;
  size_t rows;
  Quantity of[3];
} Layout;

static const Layout layouts[] = {
    /* a spreadsheet in English, and one in German */
    {"Time (s),Voltage (kV),Displacement (mm)\n0,0,0.01\n0.5,8,2.5\n",
     "",
     "",
     2,
     {{"time", "s", 0, 0.5}, {"voltage", "V", 0, 8e3}, {"displacement", "m", 1e-5, 2.5e-3}}},
    {"Zeit [s];Spannung [kV];Weg [mm]\n0;0;0,01\n0,5;8;2,5\n",
     "Zeit = time_s; Spannung = voltage_kV; Weg = displacement_mm",
     "",
     2,
     {{"time", "s", 0, 0.5}, {"voltage", "V", 0, 8e3}, {"displacement", "m", 1e-5, 2.5e-3}}},
    /* a testing machine: titles, names, units in a line of their own, quotes */
    {"\"Results Table 1\"\n\"Specimen label\",\"ERA 12\"\n\n\"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n"
     "\"0.000\",\"0.0000\",\"0.1234\"\n\"0.100\",\"0.0167\",\"0.2345\"\n",
     "Extension = displacement_mm",
     "names in line 4, units in line 5, 2 rows in lines 6 to 7",
     2,
     {{"time", "s", 0, 0.1}, {"displacement", "m", 0, 1.67e-5}, {"load", "N", 0.1234, 0.2345}}},
    /* another one in German: a preamble of keys and values, thousands with points */
    {"Datum;02.03.2025\nPr\xC3\xBC"
     "fer;K. M.\nRate;1,000;mm/min\nKraft [N];Weg [mm]\n1.234,5;2,25\n2.001,0;2,50\n",
     "Kraft = force_N; Weg = stroke_mm",
     "names in line 4, 2 rows in lines 5 to 6",
     2,
     {{"force", "N", 1234.5, 2001}, {"stroke", "m", 2.25e-3, 2.5e-3}}},
    /* points between thousands, where no number has both signs */
    {"Kraft [mN];Weg [mm]\n1.234;2,25\n12.001;2,50\n",
     "Kraft = force_mN; Weg = stroke_mm",
     "",
     2,
     {{"force", "N", 1.234, 12.001}, {"stroke", "m", 2.25e-3, 2.5e-3}}},
    /* points as points, although the separator is a semicolon */
    {"Kraft [mN];Weg [mm]\n1.23;2.25\n12.001;2.50\n",
     "Kraft = force_mN; Weg = stroke_mm",
     "",
     2,
     {{"force", "N", 1.23e-3, 12.001e-3}, {"stroke", "m", 2.25e-3, 2.5e-3}}},
    /* an oscilloscope: names and values of settings, names of channels, units */
    {"Model,SCOPE 54\nFirmware Version,1.2\nRecord Length,3\nSample Interval,4e-06\nVertical "
     "Units,V,V\n\nTIME,CH1,CH2\n"
     "s,kV,mm\n-0.004,0,0.02\n0,0,0.01\n0.004,7.9,0.3\n",
     "CH1 = voltage_kV; CH2 = stroke_mm",
     "names in line 7, units in line 8, 3 rows in lines 9 to 11",
     3,
     {{"time", "s", -0.004, 0.004}, {"voltage", "V", 0, 7900}, {"stroke", "m", 2e-5, 3e-4}}},
    /* an oscilloscope whose units are words */
    {"Source,CH1,CH2\nSecond,Volt,Volt\n0.0E+00,1.5E-01,2.0\n1.0E-03,1.6E-01,2.5\n",
     "Source = time_s; CH1 = voltage_kV",
     "names in line 1, units in line 2, 2 rows in lines 3 to 4",
     2,
     {{"time", "s", 0, 1e-3}, {"voltage", "V", 150, 160}}},
    /* a measuring program: tabs, an end of the header, a column of remarks that no row has */
    {"LabVIEW Measurement\t\nSeparator\tTab\nDate\t2025/03/02\n***End_of_Header***\t\nX_Value\tVoltage\tComment\n"
     "0.000000\t0.125000\n0.001000\t8.250000\n",
     "X_Value = time_s; Voltage = voltage_kV",
     "names in line 5, 2 rows in lines 6 to 7",
     2,
     {{"time", "s", 0, 1e-3}, {"voltage", "V", 125, 8250}}},
    /* a video tracker: units in names after a comma and without a bracket, remarks with a hash */
    {"# tracked with 240 fps\nt/s;x/mm\n0;1,5\n0,0041667;1,75\n",
     "t = time_s; x = stroke_mm",
     "",
     2,
     {{"time", "s", 0, 0.0041667}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
    {"\"Time, ms\";\"Stroke, um\"\n0;1500\n4,1667;1750\n",
     "",
     "",
     2,
     {{"time", "s", 0, 4.1667e-3}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
    /* blanks before units, and a byte order mark */
    {"\xEF\xBB\xBFTime ms,Stroke mm\r\n0,1.5\r\n4.1667,1.75\r\n",
     "",
     "",
     2,
     {{"time", "s", 0, 4.1667e-3}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
    /* times of day */
    {"Time;Stroke (mm)\n12:03:04,250;1,5\n12:03:05,500;1,75\n",
     "",
     "",
     2,
     {{"time", "s", 43384.25, 43385.5}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
    /* a laser: a number of the sample first, a foot */
    {"No.,Time[ms],Displacement[um]\n1,0,10\n2,0.5,12.5\nEnd of data\n",
     "",
     "names in line 1, 2 rows in lines 2 to 3",
     2,
     {{"time", "s", 0, 5e-4}, {"displacement", "m", 1e-5, 1.25e-5}}},
    /* a meter of capacitance: separators at the ends of lines */
    {"time_s;capacitance_pF;\n0;120,5;\n1;180,25;\n",
     "",
     "",
     2,
     {{"time", "s", 0, 1}, {"capacitance", "F", 120.5e-12, 180.25e-12}}},
    /* a supply's log with a unit of per cent and an empty unit */
    {"Supply log\nserial;4711\nTime;Voltage;Duty;Step\ns;kV;%;-\n0;0,0;0;1\n2,5;6,5;50;2\n",
     "",
     "names in line 3, units in line 4, 2 rows in lines 5 to 6",
     2,
     {{"time", "s", 0, 2.5}, {"voltage", "V", 0, 6500}}},
    /* apostrophes between thousands */
    {"Time (s);Voltage (V)\n0;1'250\n1;10'500\n", "", "", 2, {{"time", "s", 0, 1}, {"voltage", "V", 1250, 10500}}},
    /* quoted commas between thousands, in a file with commas between cells */
    {"Time (s),Force (mN),Stroke (mm)\n0,\"1,234.5\",1\n1,\"2,001.0\",2\n",
     "",
     "",
     2,
     {{"time", "s", 0, 1}, {"force", "N", 1.2345, 2.001}, {"stroke", "m", 1e-3, 2e-3}}},
    /* two tables, of which the longer one counts */
    {"Peak;Force [N];Stroke [mm]\nmax;3;4\nTime (s);Voltage (kV)\n0;1\n1;2\n2;3\n",
     "",
     "names in line 3, 3 rows in lines 4 to 6",
     3,
     {{"time", "s", 0, 2}, {"voltage", "V", 1e3, 3e3}}},
    /* columns of text among numbers */
    {"Datum;Uhrzeit;Time_ms;Stroke_mm;Bemerkung\n02.03.;ab;0;1,5;ruhig\n02.03.;cd;5;1,75;\"zu; auf\"\n",
     "",
     "",
     2,
     {{"time", "s", 0, 5e-3}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
    /* units in braces and with a Greek letter */
    {"Time {ms},Stroke <\xC2\xB5m>\n0,1500\n5,1750\n",
     "",
     "",
     2,
     {{"time", "s", 0, 5e-3}, {"stroke", "m", 1.5e-3, 1.75e-3}}},
};

static double number_of(const ZpData *data, size_t row, const Quantity *of) {
  double *value = calloc(data->rows, sizeof *value);
  ck_ok(zp_data_read_column(data, of->stem, of->unit, "such", value, &err));
  const double at = value[row];
  free(value);
  return at;
}

TESTS(layouts_are_read, 0, LENGTH_OF(layouts)) {
  const Layout *layout = &layouts[_i];
  ZpDataFiles files;
  char told[160];
  write_file("layout.csv", layout->text);
  ck_ok(zp_data_read_all("data.file", "layout.csv", layout->renamed, true, &files, &err));
  const ZpData *data = files.file;
  ck_assert_uint_eq(data->rows, layout->rows);
  zp_data_describe(data, told, sizeof told);
  ck_assert_str_eq(told, layout->told);
  for (size_t q = 0; q < LENGTH_OF(layout->of) && layout->of[q].stem; q++) {
    ck_near(number_of(data, 0, &layout->of[q]), layout->of[q].first, 1e-15);
    ck_near(number_of(data, data->rows - 1, &layout->of[q]), layout->of[q].last, 1e-15);
  }
  zp_data_files_destroy(&files);
}

static ZpStatus read_strokes(const char *text, const char *renamed, ZpError *err) {
  ZpDataFiles files;
  double value[8];
  write_file("layout.csv", text);
  ZpStatus status = zp_data_read_all("data.file", "layout.csv", renamed, true, &files, err);
  if (status == ZP_OK) status = zp_data_read_column(files.file, "stroke", "m", "such", value, err);
  zp_data_files_destroy(&files);
  return status;
}

/* Broken tables stay broken: a cell too many, a text between numbers, a group of digits that is none. */
TEST(broken_tables_are_refused) {
  static const char *const broken[][2] = {
      {"Time (s),Stroke (mm)\n0,1\n1,2,3\n2,3\n", "layout.csv:3: 3 cells; the header has 2"},
      {"Title\nTime (s),Stroke (mm)\n0,1\n1,x\n2,3\n",
       "layout.csv:4: column Stroke_mm: \"x\": text in a number column"},
      {"Time (s);Stroke (mm)\n0;1,5\n1;1.23,5\n",
       "layout.csv:3: column Stroke_mm: \"1.23,5\": text in a number column"},
  };
  for (size_t k = 0; k < LENGTH_OF(broken); k++)
    ck_says(read_strokes(broken[k][0], "", &err), ZP_BAD_INPUT, broken[k][1]);
  ck_says(read_strokes("Zeit [ms];Weg [mm]\n0;1\n1;2\n", "Zeit = time_s", &err), ZP_BAD_INPUT,
          "data.columns: Zeit = time_s: in layout.csv the unit of that column is ms");
}
